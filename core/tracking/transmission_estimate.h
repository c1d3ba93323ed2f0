#pragma once

#include <Eigen/Core>

namespace capstan::tracking {

/// Slow errors of the transmission, and of the cameras' registration beside them, as the augmented filter
/// estimates them (TransmissionEstimator). Joints are 1 to 3; zero where the filter includes no such error.
struct TransmissionEstimate {
  Eigen::Vector3d scale =
      Eigen::Vector3d::Zero();  ///< cable travel by motor travel, relative to nominal, − 1
  Eigen::Vector3d scale_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale_probability = Eigen::Vector3d::Zero();  ///< that there is one
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();             ///< of the cable's zero [m]
  Eigen::Vector3d offset_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d offset_probability = Eigen::Vector3d::Zero();
  Eigen::Vector3d compliance = Eigen::Vector3d::Zero();  ///< 1 − k_e of the robot file / k_e
  Eigen::Vector3d compliance_sigma = Eigen::Vector3d::Zero();
  Eigen::Vector3d compliance_probability = Eigen::Vector3d::Zero();
  /// Error of the tip that cameras report: rotation about the tip's position at the hard stop, in frame 0
  /// [rad], and shift [m].
  Eigen::Vector3d camera_rotation = Eigen::Vector3d::Zero(), camera_shift = Eigen::Vector3d::Zero();
  double camera_scale = 0.0;  ///< and scale about that position, relative (focal length, base line)
  double camera_delay = 0.0;  ///< stamps are later than exposures by this, beyond the option's [s]
  double camera_moved_probability = 0.0;  ///< that cameras moved since their registration
  /// Cameras and motors have ceased to agree, and which of them changed is not known yet: the errors above
  /// are those of before.
  bool change_in_question = false;

  bool includesScale(int joint) const { return scale(joint) != 0.0; }
  bool includesOffset(int joint) const { return offset(joint) != 0.0; }
  bool includesCompliance(int joint) const { return compliance(joint) != 0.0; }
  bool camerasMoved() const { return camera_moved_probability > 0.5; }
};

}  // namespace capstan::tracking
