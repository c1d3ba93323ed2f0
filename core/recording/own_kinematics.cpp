#include "core/recording/own_kinematics.h"

#include <algorithm>
#include <limits>

#include "core/base/units.h"
#include "core/robot/transmission.h"

namespace capstan::recording {
namespace {

robot::JointVector rowOf(const TableColumns& columns, std::size_t row) {
  robot::JointVector values(static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) values(static_cast<Eigen::Index>(i)) = columns[i][row];
  return values;
}

}  // namespace

bool isOwnKinematics(const MeasuredTable& table, const robot::Description& robot) {
  if (table.q.size() != robot.joints.size() || table.q_m.size() != robot.joints.size()) return false;
  const robot::Transmission transmission(robot);
  const auto shown = [&](double value, std::size_t joint) {
    return base::degreesOrMillimetres(value, robot.joints[joint].type == robot::JointType::kRevolute);
  };
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::vector<double> low(table.q.size(), kFar), high(table.q.size(), -kFar);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const robot::JointVector q = rowOf(table.q, row), q_m = rowOf(table.q_m, row);
    if (!q.allFinite() || !q_m.allFinite()) continue;
    const robot::JointVector difference = transmission.jointFromMotor(q_m) - q;
    for (std::size_t joint = 0; joint < table.q.size(); ++joint) {
      const auto i = static_cast<Eigen::Index>(joint);
      if (std::abs(shown(difference(i), joint)) > kSameAngle) return false;
      low[joint] = std::min(low[joint], shown(q(i), joint));
      high[joint] = std::max(high[joint], shown(q(i), joint));
    }
  }
  for (std::size_t joint = 0; joint < low.size(); ++joint)
    if (high[joint] - low[joint] > kOwnMotion) return true;
  return false;
}

}  // namespace capstan::recording
