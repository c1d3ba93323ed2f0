#pragma once

#include <Eigen/Core>

namespace capstan::tracking {

/// Slow errors of the transmission and of the cameras' registration, estimated by the augmented filter
/// (TransmissionEstimator). One entry per joint; 0 where the filter includes no such error.
struct TransmissionEstimate {
  Eigen::Vector3d scale =
      Eigen::Vector3d::Zero();  ///< ratio of cable travel to motor travel, relative to nominal, minus 1
  Eigen::Vector3d scale_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale_probability = Eigen::Vector3d::Zero();  ///< probability that this error exists
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();             ///< error of the cable's zero [m]
  Eigen::Vector3d offset_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_probability = Eigen::Vector3d::Zero();
  Eigen::Vector3d compliance = Eigen::Vector3d::Zero();  ///< 1 − k_file / k_true of k_e
  Eigen::Vector3d compliance_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d compliance_probability = Eigen::Vector3d::Zero();
  /// Error of the tip measured by the cameras: rotation about the tip's position at the hard stop, in frame 0
  /// [rad], and shift [m].
  Eigen::Vector3d camera_rotation = Eigen::Vector3d::Zero(), camera_shift = Eigen::Vector3d::Zero();
  double camera_scale = 0.0;  ///< relative error of scale about that position (focal length, base line)
  double camera_delay = 0.0;  ///< time stamp minus exposure, beyond TrackingOptions::camera_delay [s]
  double camera_moved_probability = 0.0;  ///< probability that cameras moved since their registration
  /// True if cameras and motors no longer agree and it is not yet known which of them changed. The errors
  /// above are then those before the change.
  bool change_in_question = false;

  bool includesScale(int joint) const { return scale(joint) != 0.0; }
  bool includesOffset(int joint) const { return offset(joint) != 0.0; }
  bool includesCompliance(int joint) const { return compliance(joint) != 0.0; }
  bool camerasMoved() const { return camera_moved_probability > 0.5; }
};

}  // namespace capstan::tracking
