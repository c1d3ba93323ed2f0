#include "core/simulation/tool_robot.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "core/base/error.h"

namespace capstan::simulation {
namespace {

constexpr int kSettling = 50;  // command periods before time 0, in which cables and motors settle

}  // namespace

ToolRobot::ToolRobot(const robot::Description& nominal, const ToolTruth& truth,
                     const robot::JointVector& start)
    : kinematics_(nominal), transmission_(nominal), arm_(nominal, truth), goal_(start) {
  if (start.size() != robot::kToolJoints || !kinematics_.insideLimits(start)) {
    std::ostringstream joints;
    joints << start.transpose();
    throw base::InputError({nominal.name, 0, "start", joints.str(), "is not seven joints inside the limits",
                            "Start inside the limits"});
  }
  commanded_ = kinematics_.pose(start);
  former_ = target_ = transmission_.motorFromJoint(start);
  arm_.reset(target_);
  for (int k = 0; k < kSettling; ++k) advance();
  t_ = 0.0;
}

bool ToolRobot::canTake(const Eigen::Isometry3d& pose, double opening) const {
  return kinematics_.solve(pose, opening, goal_).has_value();
}

bool ToolRobot::ask(const Eigen::Isometry3d& pose, double opening) {
  const auto q = kinematics_.solve(pose, opening, goal_);
  if (!q) return false;
  goal_ = *q;
  commanded_ = pose;
  target_ = transmission_.motorFromJoint(goal_);
  return true;
}

void ToolRobot::advance() {
  const int steps = static_cast<int>(std::lround(kCommandPeriod / kStep));
  const robot::JointVector rate = (target_ - former_) / kCommandPeriod;
  for (int k = 1; k <= steps; ++k) arm_.step(former_ + rate * (kCommandPeriod * k / steps), rate, kStep);
  former_ = target_;
  t_ += kCommandPeriod;
}

Eigen::Isometry3d ToolRobot::nominalPose() const {
  return kinematics_.pose(transmission_.jointFromMotor(arm_.encoders()));
}

}  // namespace capstan::simulation
