#include "core/robot/tool_kinematics.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace capstan::robot {
namespace {

/// Robot with the first three joints, and with rows 4 to 6 as the passive wrist.
Description armOf(const Description& whole) {
  if (whole.size() != kToolJoints)
    throw base::InputError({whole.name, 0, "joints", fmt::format("{}", whole.size()), "is not seven joints",
                            "Use a robot file like raven2_left_tool.yaml"});
  for (std::size_t i = 3; i < kToolJoints; ++i)
    if (whole.joints[i].type != JointType::kRevolute)
      throw base::InputError({whole.name, 0, fmt::format("joints[{}].type", i),
                              std::string(base::nameOf(whole.joints[i].type)),
                              "is not revolute, as tool roll, wrist and jaws are",
                              "Use a robot file like raven2_left_tool.yaml"});
  const DhRow& opening = whole.joints[6].dh;
  if (opening.alpha != 0.0 || opening.a != 0.0 || opening.d != 0.0 || opening.theta != 0.0)
    throw base::InputError({whole.name, 0, "joints[6].dh", "",
                            "is not 0: both jaws turn about one axis, and are closed at an opening of 0",
                            "Set alpha, a, d and theta to 0"});
  Description arm = whole;
  arm.joints.resize(3);
  arm.drives.resize(3);
  arm.coupling.resize(3);
  for (std::vector<double>& row : arm.coupling) row.resize(3);
  arm.wrist = {whole.joints[3].dh, whole.joints[4].dh, whole.joints[5].dh};
  arm.effects.clear();
  return arm;
}

}  // namespace

ToolKinematics::ToolKinematics(const Description& description)
    : arm_(armOf(description)), low_(kToolJoints), high_(kToolJoints) {
  for (int i = 0; i < kToolJoints; ++i) {
    low_[i] = description.joints[static_cast<std::size_t>(i)].limit_low;
    high_[i] = description.joints[static_cast<std::size_t>(i)].limit_high;
  }
}

Eigen::Isometry3d ToolKinematics::pose(const JointVector& q) const {
  Vector6d tool = q.head<6>();
  tool[5] += 0.5 * q[6];
  return arm_.toolPose(tool);
}

base::Result<JointVector, ReachFault> ToolKinematics::solve(const Eigen::Isometry3d& pose, double opening,
                                                            const JointVector& near) const {
  Vector6d last = near.head<6>();
  last[5] += 0.5 * near[6];
  const auto tool = arm_.solvePose(pose, last);
  if (!tool) return base::failure(tool.error());
  JointVector q(kToolJoints);
  q << *tool, opening;
  q[5] -= 0.5 * opening;
  if (!insideLimits(q)) return base::failure(ReachFault::kOutsideLimits);
  return q;
}

bool ToolKinematics::insideLimits(const JointVector& q) const {
  return (q.array() >= low_.array()).all() && (q.array() <= high_.array()).all();
}

}  // namespace capstan::robot
