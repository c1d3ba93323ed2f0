#pragma once

#include <functional>

#include "core/simulation/tool_arm.h"

namespace capstan::simulation {

/// The seven-joint arm behind its own controller, which is commanded to tool poses and knows the nominal
/// robot file alone: inverse kinematics, transmission kinematics, motor angles. It takes a pose every
/// kCommandPeriod and moves its targets there evenly; poses outside of its joint limits it refuses.
class ToolRobot {
 public:
  static constexpr double kCommandPeriod = 0.01;  ///< [s]
  static constexpr double kStep = 1e-3;           ///< of the arm [s]

  /// At rest where the nominal joints are `start`, its motors having come there from the hard stop long ago.
  /// base::InputError: no such robot, or a start outside of its limits.
  ToolRobot(const robot::Description& nominal, const ToolTruth& truth, const robot::JointVector& start);

  /// Would it take this pose (frame 0), of jaws open by `opening` [rad]?
  bool canTake(const Eigen::Isometry3d& pose, double opening) const;
  /// False: it is refused, and the last one stays.
  bool ask(const Eigen::Isometry3d& pose, double opening);
  /// One command period.
  void advance();

  double time() const { return t_; }                                   ///< [s]
  const Eigen::Isometry3d& commanded() const { return commanded_; }    ///< last pose taken
  const robot::JointVector& commandedJoints() const { return goal_; }  ///< those of it, nominal
  Eigen::Isometry3d nominalPose() const;                               ///< nominal kinematics of the encoders
  const ToolArm& arm() const { return arm_; }
  const robot::ToolKinematics& kinematics() const { return kinematics_; }

 private:
  robot::ToolKinematics kinematics_;
  robot::Transmission transmission_;
  ToolArm arm_;
  robot::JointVector goal_;             ///< nominal joints of the last pose
  robot::JointVector target_, former_;  ///< motor angles, now and a command before [rad]
  Eigen::Isometry3d commanded_;
  double t_ = 0.0;
};

}  // namespace capstan::simulation
