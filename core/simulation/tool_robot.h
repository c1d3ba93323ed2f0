#pragma once

#include <functional>

#include "core/simulation/tool_arm.h"

namespace capstan::simulation {

/// The simulated seven-joint arm with its native controller. The controller knows the nominal robot file
/// only: it maps a commanded tool pose by inverse kinematics and nominal transmission to motor angles. It
/// accepts one pose per kCommandPeriod and moves its motor targets there at constant rate. It refuses poses
/// outside the joint limits.
class ToolRobot {
 public:
  static constexpr double kCommandPeriod = 0.01;  ///< period of commands [s]
  static constexpr double kStep = 1e-3;           ///< integration step of the arm [s]

  /// Starts at rest, the motors at the angles of nominal joints `start` [rad or m] and the cables settled.
  /// Throws base::InputError for a robot without seven joints, or a start outside the joint limits.
  ToolRobot(const robot::Description& nominal, const ToolTruth& truth, const robot::JointVector& start);

  /// True when the robot would accept `pose` (frame 0) with the jaws open by `opening` [rad].
  bool canTake(const Eigen::Isometry3d& pose, double opening) const;
  /// Commands `pose` (frame 0) and `opening` [rad]. Returns false when refused; the last command then holds.
  bool ask(const Eigen::Isometry3d& pose, double opening);
  /// Advances by one command period.
  void advance();

  double time() const { return t_; }                                 ///< [s]
  const Eigen::Isometry3d& commanded() const { return commanded_; }  ///< last accepted pose
  const robot::JointVector& commandedJoints() const {
    return goal_;
  }                                       ///< nominal joints of the last accepted pose
  Eigen::Isometry3d nominalPose() const;  ///< pose by encoders and nominal kinematics
  const ToolArm& arm() const { return arm_; }
  const robot::ToolKinematics& kinematics() const { return kinematics_; }

 private:
  robot::ToolKinematics kinematics_;
  robot::Transmission transmission_;
  ToolArm arm_;
  robot::JointVector goal_;             ///< nominal joints of the last accepted pose
  robot::JointVector target_, former_;  ///< motor angles of the present and the previous command [rad]
  Eigen::Isometry3d commanded_;
  double t_ = 0.0;
};

}  // namespace capstan::simulation
