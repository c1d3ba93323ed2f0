#include "core/registration/registration_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/robot/arm_kinematics.h"
#include "core/stats/quantile.h"

namespace capstan::registration {

std::vector<Eigen::Vector3d> workspaceTips(const robot::Description& robot) {
  constexpr int kPoses = 27;
  const robot::ArmKinematics arm(robot);
  std::vector<Eigen::Vector3d> tips;
  for (int pose = 0; pose < kPoses; ++pose) {
    Eigen::Vector3d q;
    for (int joint = 0, rest = pose; joint < 3; ++joint, rest /= 3) {
      const robot::Joint& limits = robot.joints[static_cast<std::size_t>(joint)];
      q(joint) = limits.limit_low + 0.5 * (rest % 3) * (limits.limit_high - limits.limit_low);
    }
    tips.push_back(arm.tip(q));
  }
  return tips;
}

RegistrationDifference differenceOf(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                    const robot::Description& robot) {
  RegistrationDifference difference;
  difference.translation = to.translation() - from.translation();
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  difference.rotation = std::abs(turn.angle());
  std::vector<double> shifts;
  for (const Eigen::Vector3d& tip : workspaceTips(robot))
    shifts.push_back((to * (from.inverse() * tip) - tip).norm());
  difference.tool = {stats::median(shifts), *std::ranges::max_element(shifts)};
  return difference;
}

std::string wordsOf(const RegistrationDifference& difference) {
  const auto mm = [](double metres) {
    const std::string text = fmt::format("{:.2f}", std::abs(base::toMillimetres(metres)));
    return (metres < 0.0 && text != "0.00" ? "−" : "") + text;
  };
  const Eigen::Vector3d& moved = difference.translation;
  return fmt::format(
      "translation {} mm ({}, {}, {}), rotation {:.2f}°, at the tool {} mm, at most {} mm over the workspace",
      mm(moved.norm()), mm(moved.x()), mm(moved.y()), mm(moved.z()), base::toDegrees(difference.rotation),
      mm(difference.tool.median), mm(difference.tool.largest));
}

}  // namespace capstan::registration
