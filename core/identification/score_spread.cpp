#include "core/identification/score_spread.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace capstan::identification {

void ScoreSpread::add(double t, const ParameterFilter::Innovation& innovation,
                      const Eigen::Matrix3d& by_discrepancy) {
  if (!started_) start_ = discrepancy_start_ = t;
  started_ = true;
  if (t - start_ >= block_) close(t);
  if (t - discrepancy_start_ >= discrepancy_memory_) closeDiscrepancy(t);
  // With R alone, the first innovations, which are those of wrong parameters, would widen σ for minutes.
  const Eigen::Matrix3d inverse =
      innovation.weight * innovation.innovation_covariance.llt().solve(Eigen::Matrix3d::Identity());
  const auto& h = innovation.by_unknown;
  score_ += h.transpose() * inverse * innovation.value;
  block_information_ += h.transpose() * inverse * h;
  discrepancy_score_ += h.transpose() * inverse * by_discrepancy;
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

void ScoreSpread::closeDiscrepancy(double t) {
  discrepancy_ = std::exp(-(t - discrepancy_start_) / memory_) * discrepancy_ +
                 discrepancy_score_ * discrepancy_score_.transpose();
  discrepancy_score_.setZero();
  discrepancy_start_ = t;
}

ScoreSpread::Unknowns ScoreSpread::factors(const Square& covariance) const {
  constexpr double kFewest = 5.0;
  if (blocks_ < kFewest) return Unknowns::Ones();
  const Square stated = covariance * information_ * covariance, found = covariance * meat_ * covariance,
               discrepant = covariance * discrepancy_ * covariance;
  Unknowns factor;
  for (int i = 0; i < factor.size(); ++i) {
    const double noise = stated(i, i), most = std::max(found(i, i), noise + discrepant(i, i));
    factor(i) = noise > 0.0 ? std::sqrt(std::max(1.0, most / noise)) : 1.0;
  }
  return factor;
}

}  // namespace capstan::identification
