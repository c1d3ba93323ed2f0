#include "core/learning/exact_process.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A = K⁻¹ Y from K = L Lᵀ.
MatrixXd solved(const MatrixXd& root, MatrixXd y) {
  math::solveLower(root, y);
  math::solveLowerTransposed(root, y);
  return y;
}

/// Of a symmetric matrix told by its lower triangle: the sums of its rows.
VectorXd rowSums(const MatrixXd& lower) { return math::timesSymmetric(lower, VectorXd::Ones(lower.rows())); }

/// ½ Σ_ab M_ab (z_ai − z_bi)² = Σ_a s_a z_ai² − z_iᵀ M z_i, s = M 1, of each feature i.
VectorXd byLengths(const MatrixXd& m, const MatrixXd& z) {
  const VectorXd sums = rowSums(m);
  return (z.array().square().colwise() * sums.array()).colwise().sum().matrix().transpose() -
         z.cwiseProduct(math::timesSymmetric(m, z)).colwise().sum().transpose();
}

}  // namespace

std::optional<double> negativeLogLikelihood(const MatrixXd& x, const MatrixXd& y,
                                            const KernelParameters& parameters, VectorXd* gradient) {
  assert(x.rows() == y.rows());
  const auto n = static_cast<double>(x.rows()), outputs = static_cast<double>(y.cols());
  const MatrixXd z = inLengths(x, parameters);
  MatrixXd signal = signalCovariance(z, parameters);
  MatrixXd k = signal;
  k.diagonal().array() += parameters.noiseVariance();
  if (!math::choleskyInPlace(k)) return std::nullopt;
  const MatrixXd weights = solved(k, y);
  const double value =
      0.5 * y.cwiseProduct(weights).sum() +
      outputs * (k.diagonal().array().log().sum() + 0.5 * n * std::log(2.0 * std::numbers::pi));
  if (!gradient) return value;
  math::invertFromCholesky(k);
  k.triangularView<Eigen::Lower>() *= outputs;
  math::addSquare(-1.0, weights, k);  // W
  const double trace = k.diagonal().sum();
  for (Index c = 0; c < k.cols(); ++c)
    signal.col(c).tail(k.rows() - c).array() *= k.col(c).tail(k.rows() - c).array();
  gradient->resize(2 + parameters.ln_length.size());
  (*gradient)[0] = rowSums(signal).sum();
  timesLengthSlope(z, parameters, signal);
  const VectorXd lengths = byLengths(signal, z);
  (*gradient)[1] = parameters.noiseVariance() * trace;
  if (parameters.ln_length.size() == 1)
    (*gradient)[2] = lengths.sum();
  else
    gradient->tail(lengths.size()) = lengths;
  return value;
}

ExactProcess::ExactProcess(const MatrixXd& x, const MatrixXd& y, KernelParameters parameters)
    : parameters_(std::move(parameters)), z_(inLengths(x, parameters_)) {
  assert(x.rows() == y.rows() && x.rows() > 0);
  constexpr double kLeast = 1e-12;
  const MatrixXd signal = signalCovariance(z_, parameters_);
  for (;; jitter_ = jitter_ == 0.0 ? kLeast : 10.0 * jitter_) {
    root_ = signal;
    root_.diagonal().array() += parameters_.noiseVariance() + jitter_ * parameters_.signalVariance();
    if (math::choleskyInPlace(root_) || jitter_ > 1.0) break;
  }
  weights_ = solved(root_, y);
}

MatrixXd ExactProcess::mean(const MatrixXd& at) const {
  return math::product(crossCovariance(inLengths(at, parameters_), z_, parameters_), weights_);
}

Prediction ExactProcess::predict(const MatrixXd& at) const {
  MatrixXd cross = crossCovariance(z_, inLengths(at, parameters_), parameters_);
  Prediction prediction{math::product(cross.transpose(), weights_), {}};
  math::solveLower(root_, cross);
  prediction.variance =
      (parameters_.signalVariance() - cross.colwise().squaredNorm().transpose().array()).max(0.0);
  return prediction;
}

}  // namespace capstan::learning
