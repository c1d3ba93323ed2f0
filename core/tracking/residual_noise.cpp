#include "core/tracking/residual_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// One more sample of a running mean; `size` is by how much its square exceeds what is expected.
void average(const Vector3d& sample, double size, double outlier, int count, Matrix3d& mean) {
  const double weight = size > outlier ? outlier / size : 1.0;
  mean += (weight * sample * sample.transpose() - mean) / count;
}

}  // namespace

WhiteNoise::WhiteNoise(int memory, double gap)
    : memory_(memory == 0 ? 0 : std::max(memory, kEnough)), gap_(gap) {}

void WhiteNoise::add(double t, const Vector3d& residual, const Matrix3d& stated) {
  if (memory_ == 0 || !residual.allFinite()) return;
  if (neighbours_ > 0 && (t <= newest_ || t - newest_ > gap_)) neighbours_ = 0;
  newest_ = t;
  if (neighbours_ >= 2) {
    const Vector3d difference = (residual - 2.0 * before_[1] + before_[0]) / std::sqrt(6.0);
    const double size = difference.dot(value(stated).llt().solve(difference)) / 3.0;
    differences_ = std::min(differences_ + 1, memory_);
    average(difference, size, kOutlier, differences_, measured_);
  }
  before_[0] = before_[1];
  before_[1] = residual;
  ++neighbours_;
}

}  // namespace capstan::tracking
