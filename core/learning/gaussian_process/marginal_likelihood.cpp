#include "core/learning/gaussian_process/marginal_likelihood.h"

#include <cmath>
#include <numbers>

#include "core/base/check.h"
#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// ½ Σ_ab M_ab (z_ai − z_bi)² = Σ_a s_a z_ai² − z_iᵀ M z_i, s = M 1, for each feature i; M symmetric, given
/// by its lower triangle.
VectorXd byLengths(const MatrixXd& m, const MatrixXd& z) {
  MatrixXd with_ones(z.rows(), z.cols() + 1);
  with_ones << z, VectorXd::Ones(z.rows());
  const MatrixXd times = math::timesSymmetric(m, with_ones);
  const auto sums = times.col(z.cols());
  return (z.array().square().colwise() * sums.array()).colwise().sum().matrix().transpose() -
         z.cwiseProduct(times.leftCols(z.cols())).colwise().sum().transpose();
}

/// M ← M ∘ W; returns the sum of all elements. Both are symmetric and given by their lower triangles.
double multiplyElements(const MatrixXd& w, MatrixXd& m) {
  double below = 0.0;
  for (Index c = 0; c < m.cols(); ++c) {
    auto column = m.col(c).tail(m.rows() - c).array();
    column *= w.col(c).tail(m.rows() - c).array();
    below += column.sum();
  }
  return 2.0 * below - m.diagonal().sum();
}

}  // namespace

MarginalLikelihood::MarginalLikelihood(const MatrixXd& x, const MatrixXd& y) : x_(x), y_(y) {
  CAPSTAN_CHECK(x.rows() == y.rows());
}

std::optional<double> MarginalLikelihood::negativeLog(const KernelParameters& parameters,
                                                      VectorXd* gradient) {
  const auto n = static_cast<double>(x_.rows()), outputs = static_cast<double>(y_.cols());
  const MatrixXd z = inLengths(x_, parameters);
  setSignalCovariance(z, parameters, signal_);
  covariance_ = signal_;
  covariance_.diagonal().array() += parameters.noiseVariance();
  if (!math::choleskyInPlace(covariance_)) return std::nullopt;
  MatrixXd weights = y_;
  math::solveLower(covariance_, weights);
  math::solveLowerTransposed(covariance_, weights);
  const double value =
      0.5 * y_.cwiseProduct(weights).sum() +
      outputs * (covariance_.diagonal().array().log().sum() + 0.5 * n * std::log(2.0 * std::numbers::pi));
  if (!gradient) return value;
  math::invertFromCholesky(covariance_);
  covariance_.triangularView<Eigen::Lower>() *= outputs;
  math::addSquare(-1.0, weights, covariance_);  // W
  const double trace = covariance_.diagonal().sum();
  gradient->resize(2 + parameters.ln_length.size());
  (*gradient)[0] = multiplyElements(covariance_, signal_);
  timesLengthSlope(z, parameters, signal_, covariance_);
  const VectorXd lengths = byLengths(signal_, z);
  (*gradient)[1] = parameters.noiseVariance() * trace;
  if (parameters.ln_length.size() == 1)
    (*gradient)[2] = lengths.sum();
  else
    gradient->tail(lengths.size()) = lengths;
  return value;
}

}  // namespace capstan::learning
