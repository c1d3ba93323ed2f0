#include "tests/support/exact_process.h"

#include <cmath>

#include "core/base/check.h"
#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

/// A = K⁻¹ Y from K = L Lᵀ.
MatrixXd solved(const MatrixXd& root, MatrixXd y) {
  math::solveLower(root, y);
  math::solveLowerTransposed(root, y);
  return y;
}

}  // namespace

ExactProcess::ExactProcess(const MatrixXd& x, const MatrixXd& y, KernelParameters parameters)
    : parameters_(std::move(parameters)), z_(inLengths(x, parameters_)) {
  CAPSTAN_CHECK(x.rows() == y.rows() && x.rows() > 0);
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
