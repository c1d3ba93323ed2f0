#include "core/learning/gaussian_process/sparse_process.h"

#include <algorithm>
#include <numeric>

#include "core/base/check.h"
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

SparseProcess::SparseProcess(const MatrixXd& inducing, Index outputs, KernelParameters parameters)
    : SparseProcess(SparseProcessParts{parameters, inLengths(inducing, parameters),
                                       MatrixXd::Identity(inducing.rows(), inducing.rows()),
                                       MatrixXd::Zero(inducing.rows(), outputs)}) {}

SparseProcess::SparseProcess(SparseProcessParts parts) : known_(std::move(parts)) {
  findRoot();
  factorise();
}

void SparseProcess::findRoot() {
  const MatrixXd covariance = signalCovariance(known_.inducing, known_.parameters);
  for (double jitter = 1e-10;; jitter *= 10.0) {  // times the signal variance; inducing points may be close
    root_ = covariance;
    root_.diagonal().array() += jitter * known_.parameters.signalVariance();
    if (math::choleskyInPlace(root_) || jitter > 1.0) break;
  }
}

void SparseProcess::add(const MatrixXd& x, const MatrixXd& y) { add(x, y, Eigen::VectorXd::Zero(x.rows())); }

void SparseProcess::add(const MatrixXd& x, const MatrixXd& y, const Eigen::VectorXd& besides) {
  CAPSTAN_ASSERT(x.rows() == y.rows() && x.rows() == besides.size() && y.cols() == known_.sum.cols());
  constexpr Index kRows = 2048;  // rows per block, to limit memory
  const Eigen::VectorXd root_precision = (known_.parameters.noiseVariance() + besides.array()).rsqrt();
  for (Index first = 0; first < x.rows(); first += kRows) {
    const Index rows = std::min(kRows, x.rows() - first);
    MatrixXd v = crossCovariance(known_.inducing, inLengths(x.middleRows(first, rows), known_.parameters),
                                 known_.parameters);
    math::solveLower(root_, v);
    const auto by_row = root_precision.segment(first, rows).asDiagonal();
    v = v * by_row;
    math::addSquare(1.0, v, known_.square);
    known_.sum += math::product(v, by_row * y.middleRows(first, rows));
  }
  factorise();
}

void SparseProcess::factorise() {
  factor_ = known_.square;
  const bool fine = math::choleskyInPlace(factor_);
  CAPSTAN_ASSERT(fine);  // identity plus squares, always positive definite
  static_cast<void>(fine);
  weights_ = known_.sum;
  math::solveLower(factor_, weights_);
  math::solveLowerTransposed(factor_, weights_);
  math::solveLowerTransposed(root_, weights_);
}

MatrixXd SparseProcess::mean(const MatrixXd& at) const {
  return math::product(crossCovariance(inLengths(at, known_.parameters), known_.inducing, known_.parameters),
                       weights_);
}

Prediction SparseProcess::predict(const MatrixXd& at) const {
  MatrixXd cross = crossCovariance(known_.inducing, inLengths(at, known_.parameters), known_.parameters);
  Prediction prediction{math::product(cross.transpose(), weights_), {}};
  math::solveLower(root_, cross);
  prediction.variance =
      known_.parameters.signalVariance() - cross.colwise().squaredNorm().transpose().array();
  math::solveLower(factor_, cross);
  prediction.variance += cross.colwise().squaredNorm().transpose();
  prediction.variance = prediction.variance.cwiseMax(0.0);
  return prediction;
}

MatrixXd SparseProcess::covariance(const MatrixXd& at) const {
  const MatrixXd scaled = inLengths(at, known_.parameters);
  MatrixXd cross = crossCovariance(known_.inducing, scaled, known_.parameters);
  math::solveLower(root_, cross);
  MatrixXd covariance = crossCovariance(scaled, scaled, known_.parameters);
  covariance -= math::product(cross.transpose(), cross);
  math::solveLower(factor_, cross);
  covariance += math::product(cross.transpose(), cross);
  return covariance;
}

}  // namespace capstan::learning
