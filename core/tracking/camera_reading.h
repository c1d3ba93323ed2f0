#pragma once

#include "core/robot/chain/chain_model.h"

namespace capstan::tracking {

/// Camera measurements, corrected by the robot file's numbers (robot::CameraNumbers).
class CameraReading {
 public:
  explicit CameraReading(const robot::Description& robot)
      : numbers_(robot::ChainModel(robot).camera),
        misleading_(!numbers_.rotation.isZero(0.0) || !numbers_.offset.isZero(0.0) || numbers_.scale != 0.0) {
  }

  /// Exposure time of an image with the time stamp t [s].
  double time(double t) const { return t - numbers_.delay; }
  /// True tip position for the measured position `measured` [m], frame 0.
  Eigen::Vector3d point(const Eigen::Vector3d& measured) const {
    return misleading_ ? numbers_.undo(measured) : measured;
  }
  Eigen::Matrix3d covariance(const Eigen::Matrix3d& measured) const {
    return misleading_ ? numbers_.undo(measured) : measured;
  }
  /// Position that the cameras measure for a tip at `point` [m], frame 0.
  Eigen::Vector3d measured(const Eigen::Vector3d& point) const {
    return misleading_ ? numbers_.measure(point) : point;
  }

 private:
  robot::CameraNumbers numbers_;
  bool misleading_;
};

}  // namespace capstan::tracking
