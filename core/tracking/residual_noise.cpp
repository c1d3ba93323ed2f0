#include "core/tracking/residual_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastClock = 1e-5, kMostClock = 0.1;  ///< bounds of a measured standard deviation [s]

/// −∞ for 0, which no score changes.
double logVariance(double sigma) { return 2.0 * std::log(sigma); }

}  // namespace

WhiteNoise::WhiteNoise(int memory, double gap, double clock_sigma)
    : memory_(memory == 0 ? 0 : std::max(memory, kEnough)),
      gap_(gap),
      stated_clock_sigma_(clock_sigma),
      log_clock_(logVariance(clock_sigma)) {}

void WhiteNoise::add(double t, const Vector3d& residual, const Vector3d& speed, const Matrix3d& stated) {
  if (memory_ == 0 || !residual.allFinite() || !speed.allFinite()) return;
  if (neighbours_ > 0 && (t <= newest_ || t - newest_ > gap_)) neighbours_ = 0;
  newest_ = t;
  const Residual now{residual, speed};
  if (neighbours_ >= 2) addDifference(now, stated);
  before_[0] = before_[1];
  before_[1] = now;
  ++neighbours_;
}

void WhiteNoise::addDifference(const Residual& now, const Matrix3d& stated) {
  const auto square = [](const Residual& r) -> Matrix3d { return r.speed * r.speed.transpose(); };
  const Vector3d difference = (now.value - 2.0 * before_[1].value + before_[0].value) / std::sqrt(6.0);
  const Matrix3d speeds = (square(now) + 4.0 * square(before_[1]) + square(before_[0])) / 6.0;
  const Matrix3d r = ofMeasurement(stated);
  const double clock = std::exp(log_clock_);
  const Eigen::LLT<Matrix3d> expected(r + clock * speeds);
  const Vector3d weighted = expected.solve(difference);
  const double size = difference.dot(weighted) / 3.0;
  const double weight = size > kOutlier ? kOutlier / size : 1.0;
  // E[v vᵀ] of the measurement's part v of the difference.
  const Matrix3d part = weight * r * weighted * weighted.transpose() * r + r - r * expected.solve(r);
  // The weights of the differences rise to a memory's: while s is not known yet, R is too large.
  differences_ = std::min(differences_ + 1, 2 * memory_);
  measured_ += 2.0 / (differences_ + 1) * (part - measured_);

  if (clock == 0.0) return;
  const Matrix3d share = clock * expected.solve(speeds);
  const double score = 0.5 * (weight * clock * weighted.dot(speeds * weighted) - share.trace());
  information_ = std::min(information_ + 0.5 * share.cwiseProduct(share.transpose()).sum(), 0.5 * memory_);
  log_clock_ = std::clamp(log_clock_ + std::clamp(score / information_, -1.0, 1.0), logVariance(kLeastClock),
                          logVariance(kMostClock));
}

}  // namespace capstan::tracking
