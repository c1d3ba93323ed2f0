#pragma once

#include "core/robot/arm_kinematics.h"

namespace capstan::robot {

/// Kinematics of a robot file with seven driven joints: a remote-centre arm, tool roll, wrist, and two jaws
/// with one common axis. q = (q1, q2 [rad], q3 [m], roll, wrist, jaw, opening [rad]). Joint 6 rotates jaw
/// one; joint 7 rotates jaw two relative to jaw one. The tool's frame lies between the jaws at the angle jaw
/// + opening / 2. ArmKinematics computes its pose in closed form from joints one to six and half the opening.
class ToolKinematics {
 public:
  /// Throws base::InputError when there are not seven joints, or they do not have this form
  /// (remote_centre.h).
  explicit ToolKinematics(const Description& description);

  /// Pose of the tool's frame in frame 0 (frame0_from_tool).
  Eigen::Isometry3d pose(const JointVector& q) const;
  /// Joint positions for a pose, on the branch nearest to `near`, within the limits of the robot file.
  base::Result<JointVector, ReachFault> solve(const Eigen::Isometry3d& pose, double opening,
                                              const JointVector& near) const;
  /// Whether each joint is within the limits of the robot file.
  bool insideLimits(const JointVector& q) const;

 private:
  ArmKinematics arm_;
  JointVector low_, high_;
};

inline constexpr int kToolJoints = 7;

}  // namespace capstan::robot
