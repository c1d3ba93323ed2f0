#pragma once

#include "core/robot/chain/chain_model.h"

namespace capstan::tracking {

/// What cameras tell, made right by what a robot file says of them (robot::CameraNumbers).
class CameraReading {
 public:
  explicit CameraReading(const robot::Description& robot)
      : numbers_(robot::ChainModel(robot).camera),
        misleading_(!numbers_.rotation.isZero(0.0) || !numbers_.offset.isZero(0.0) || numbers_.scale != 0.0) {
  }

  /// When what is stamped t was exposed [s].
  double time(double t) const { return t - numbers_.delay; }
  /// Where the tip is that is told to be at `told` [m], frame 0.
  Eigen::Vector3d point(const Eigen::Vector3d& measured) const {
    return misleading_ ? numbers_.undo(measured) : measured;
  }
  Eigen::Matrix3d covariance(const Eigen::Matrix3d& measured) const {
    return misleading_ ? numbers_.undo(measured) : measured;
  }
  /// Where a tip at `point` will be told to be.
  Eigen::Vector3d measured(const Eigen::Vector3d& point) const {
    return misleading_ ? numbers_.measure(point) : point;
  }

 private:
  robot::CameraNumbers numbers_;
  bool misleading_;
};

}  // namespace capstan::tracking
