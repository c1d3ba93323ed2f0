#include "core/tracking/residual_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>

namespace capstan::tracking {

using Eigen::Matrix3d;
using Eigen::Vector3d;

WhiteNoise::WhiteNoise(int memory, double gap) : memory_(std::max(memory, kPrior + 1)), gap_(gap) {}

void WhiteNoise::add(double t, const Vector3d& residual, const Matrix3d& stated) {
  if (!residual.allFinite()) return;
  if (neighbours_ > 0 && (t <= newest_ || t - newest_ > gap_)) neighbours_ = 0;
  newest_ = t;
  if (neighbours_ >= 2) {
    const Vector3d difference = residual - 2.0 * before_[1] + before_[0];
    const Matrix3d before = value(stated);
    const double size = difference.dot(before.llt().solve(difference)) / 18.0;
    const double weight = size > kOutlier ? kOutlier / size : 1.0;
    differences_ = std::min(differences_ + 1, memory_ - kPrior);
    measured_ =
        before + (weight / 6.0 * difference * difference.transpose() - before) / (kPrior + differences_);
  }
  before_[0] = before_[1];
  before_[1] = residual;
  ++neighbours_;
}

void InnovationCovariance::add(const Vector3d& innovation, double nis, const Matrix3d& predicted) {
  if (!innovation.allFinite()) return;
  const Matrix3d before = value(predicted);
  const double size = nis / 3.0;
  const double weight = size > kOutlier ? kOutlier / size : 1.0;
  count_ = std::min(count_ + 1, std::max(memory_ - kPrior, 1));
  measured_ = before + (weight * innovation * innovation.transpose() - before) / (kPrior + count_);
}

}  // namespace capstan::tracking
