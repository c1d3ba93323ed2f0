#include "core/identification/score_spread.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace capstan::identification {

void ScoreSpread::add(double t, const ParameterFilter::Innovation& innovation) {
  if (count_ > 0 && t - start_ >= block_) close();
  if (count_++ == 0) start_ = t;
  // The score is of the innovation as the filter would have whitened it: covariance R + H P Hᵀ is near R once
  // P is small, and before that blocks say little.
  const Eigen::Matrix3d inverse =
      innovation.weight * innovation.covariance.llt().solve(Eigen::Matrix3d::Identity());
  const auto& h = innovation.by_unknown;
  score_ += h.transpose() * inverse * innovation.value;
  block_information_ += h.transpose() * inverse * h;
}

void ScoreSpread::close() {
  const double kept = std::exp(-block_ / memory_);
  information_ = kept * information_ + block_information_;
  meat_ = kept * meat_ + score_ * score_.transpose();
  blocks_ = kept * blocks_ + 1.0;
  score_.setZero();
  block_information_.setZero();
  count_ = 0;
}

ScoreSpread::Unknowns ScoreSpread::factors(const Square& covariance) const {
  constexpr double kFewest = 5.0;
  if (blocks_ < kFewest) return Unknowns::Ones();
  const Square believed = covariance * information_ * covariance, found = covariance * meat_ * covariance;
  Unknowns factor;
  for (int i = 0; i < factor.size(); ++i)
    factor(i) = std::sqrt(std::max(1.0, believed(i, i) > 0.0 ? found(i, i) / believed(i, i) : 1.0));
  return factor;
}

}  // namespace capstan::identification
