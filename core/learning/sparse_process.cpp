#include "core/learning/sparse_process.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/base/random.h"
#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<Index> drawnPoints(Index points, Index count, std::uint64_t seed) {
  std::vector<Index> all(static_cast<std::size_t>(points));
  std::iota(all.begin(), all.end(), Index{0});
  if (count >= points) return all;
  base::Random random(seed, "inducing points");
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)  // Fisher and Yates
    std::swap(all[k], all[k + random.bits() % (all.size() - k)]);
  all.resize(static_cast<std::size_t>(count));
  std::sort(all.begin(), all.end());
  return all;
}

SparseProcess::SparseProcess(const MatrixXd& inducing, Index outputs, RbfParameters parameters)
    : parameters_(std::move(parameters)), z_(inLengths(inducing, parameters_)) {
  const MatrixXd covariance = signalCovariance(z_, parameters_);
  for (double jitter = 1e-10;; jitter *= 10.0) {  // of the signal's variance: inducing points may be near
    root_ = covariance;
    root_.diagonal().array() += jitter * parameters_.signalVariance();
    if (math::choleskyInPlace(root_) || jitter > 1.0) break;
  }
  square_ = MatrixXd::Identity(z_.rows(), z_.rows());
  sum_ = MatrixXd::Zero(z_.rows(), outputs);
  factorise();
}

void SparseProcess::add(const MatrixXd& x, const MatrixXd& y) {
  assert(x.rows() == y.rows() && y.cols() == sum_.cols());
  constexpr Index kRows = 2048;  // at a time, for memory
  const double precision = 1.0 / parameters_.noiseVariance();
  for (Index first = 0; first < x.rows(); first += kRows) {
    const Index rows = std::min(kRows, x.rows() - first);
    MatrixXd v = crossCovariance(z_, inLengths(x.middleRows(first, rows), parameters_), parameters_);
    math::solveLower(root_, v);
    math::addSquare(precision, v, square_);
    sum_ += precision * math::product(v, y.middleRows(first, rows));
  }
  factorise();
}

void SparseProcess::factorise() {
  factor_ = square_;
  const bool fine = math::choleskyInPlace(factor_);
  assert(fine);  // the identity and squares
  static_cast<void>(fine);
  weights_ = sum_;
  math::solveLower(factor_, weights_);
  math::solveLowerTransposed(factor_, weights_);
  math::solveLowerTransposed(root_, weights_);
}

MatrixXd SparseProcess::mean(const MatrixXd& at) const {
  return math::product(crossCovariance(inLengths(at, parameters_), z_, parameters_), weights_);
}

Prediction SparseProcess::predict(const MatrixXd& at) const {
  MatrixXd cross = crossCovariance(z_, inLengths(at, parameters_), parameters_);
  Prediction prediction{math::product(cross.transpose(), weights_), {}};
  math::solveLower(root_, cross);
  prediction.variance = parameters_.signalVariance() - cross.colwise().squaredNorm().transpose().array();
  math::solveLower(factor_, cross);
  prediction.variance += cross.colwise().squaredNorm().transpose();
  prediction.variance = prediction.variance.cwiseMax(0.0);
  return prediction;
}

}  // namespace capstan::learning
