#pragma once

#include "core/robot/arm_kinematics.h"

namespace capstan::robot {

/// Kinematics of a robot file with seven driven joints: a remote-centre arm, tool roll, wrist, and two jaws
/// about one axis. q = (q1, q2 [rad], q3 [m], roll, wrist, jaw, opening [rad]): joint 6 turns jaw one, joint
/// 7 jaw two against it, and the tool's frame lies between them, at the angle jaw + opening / 2. Joints one
/// to six and half the opening are ArmKinematics' tool pose, in closed form.
class ToolKinematics {
 public:
  /// base::InputError: not seven joints, or not of this shape (remote_centre.h).
  explicit ToolKinematics(const Description& description);

  /// Frame 0 from the tool's frame.
  Eigen::Isometry3d pose(const JointVector& q) const;
  /// Joints of a pose, on the branch nearest to `near`, and strictly inside the limits of the robot file.
  base::Result<JointVector, ReachFault> solve(const Eigen::Isometry3d& pose, double opening,
                                              const JointVector& near) const;
  /// Each joint within the limits of the robot file.
  bool insideLimits(const JointVector& q) const;

 private:
  ArmKinematics arm_;
  JointVector low_, high_;
};

inline constexpr int kToolJoints = 7;

}  // namespace capstan::robot
