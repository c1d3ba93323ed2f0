#include "core/identification/score_spread.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace capstan::identification {

void ScoreSpread::add(double t, const ParameterFilter::Innovation& innovation,
                      const Eigen::Matrix3d& by_doubt) {
  if (!started_) start_ = doubt_start_ = t;
  started_ = true;
  if (t - start_ >= block_) close(t);
  if (t - doubt_start_ >= doubt_memory_) closeDoubt(t);
  // The score is of the innovation as the filter would have whitened it: covariance R + H P Hᵀ is near R once
  // P is small, and before that blocks say little.
  const Eigen::Matrix3d inverse =
      innovation.weight * innovation.covariance.llt().solve(Eigen::Matrix3d::Identity());
  const auto& h = innovation.by_unknown;
  score_ += h.transpose() * inverse * innovation.value;
  block_information_ += h.transpose() * inverse * h;
  doubt_score_ += h.transpose() * inverse * by_doubt;
}

void ScoreSpread::close(double t) {
  const double kept = std::exp(-(t - start_) / memory_);
  information_ = kept * information_ + block_information_;
  meat_ = kept * meat_ + score_ * score_.transpose();
  blocks_ = kept * blocks_ + 1.0;
  score_.setZero();
  block_information_.setZero();
  start_ = t;
}

void ScoreSpread::closeDoubt(double t) {
  doubt_ = std::exp(-(t - doubt_start_) / memory_) * doubt_ + doubt_score_ * doubt_score_.transpose();
  doubt_score_.setZero();
  doubt_start_ = t;
}

ScoreSpread::Unknowns ScoreSpread::factors(const Square& covariance) const {
  constexpr double kFewest = 5.0;
  if (blocks_ < kFewest) return Unknowns::Ones();
  const Square believed = covariance * information_ * covariance, found = covariance * meat_ * covariance,
               doubted = covariance * doubt_ * covariance;
  Unknowns factor;
  for (int i = 0; i < factor.size(); ++i) {
    const double noise = believed(i, i), most = std::max(found(i, i), noise + doubted(i, i));
    factor(i) = noise > 0.0 ? std::sqrt(std::max(1.0, most / noise)) : 1.0;
  }
  return factor;
}

}  // namespace capstan::identification
