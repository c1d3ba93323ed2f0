#include "core/live/motor_arrangement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/base/shown_number.h"
#include "core/base/units.h"

namespace capstan::live {
namespace {

using Eigen::Vector3d;

constexpr const char* kRemedy =
    "Check motors (which motor drives which joint), signs (-1 where a motor counts the other way) and "
    "read_as (units) of the live set-up, or the robot file";

/// Median of the finite values; NaN without any.
double medianOf(std::vector<double> values) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string shown(const robot::Joint& joint, double value) {
  const bool angle = joint.type == robot::JointType::kRevolute;
  return base::withMinus(
      fmt::format("{:.1f}{}", base::degreesOrMillimetres(value, angle), angle ? "°" : " mm"));
}

std::string columnOf(int motor) { return fmt::format("q_m{}", motor); }

}  // namespace

MotorArrangement::MotorArrangement(const RowsSetup& setup, robot::Description robot,
                                   recording::ReadAs read_as)
    : motors_(setup.motors),
      signs_(setup.signs),
      robot_(std::move(robot)),
      transmission_(robot_),
      read_as_(std::move(read_as)) {}

void MotorArrangement::apply(tracking::MotorSample& sample) const {
  const tracking::MotorSample given = sample;
  for (int k = 0; k < 3; ++k) {
    const auto joint = static_cast<std::size_t>(k);
    const int from = motors_[joint] - 1;
    sample.position[k] = signs_[joint] * given.position[from];
    sample.velocity[k] = signs_[joint] * given.velocity[from];
    sample.torque[k] = signs_[joint] * given.torque[from];
  }
}

bool MotorArrangement::check(const recording::MeasuredTable& rows) const {
  const Vector3d q = jointOf(rows, Vector3d::Ones());
  if (!q.array().isFinite().any()) return false;
  checkLimits(rows, q);
  checkDegrees(rows, q);
  return true;
}

bool MotorArrangement::checkUnits(const recording::MeasuredTable& rows) const {
  const Vector3d q = jointOf(rows, Vector3d::Ones());
  if (!q.array().isFinite().any()) return false;
  checkDegrees(rows, q);
  return true;
}

/// Joint positions of the median motor positions, each times the factor of its column.
Vector3d MotorArrangement::jointOf(const recording::MeasuredTable& rows, const Vector3d& factor) const {
  tracking::MotorSample sample;
  for (int k = 0; k < 3; ++k)
    sample.position[k] = factor[k] * medianOf(rows.q_m[static_cast<std::size_t>(k)]);
  apply(sample);
  // An encoder that is lost leaves the joints that its motor does not move.
  Vector3d present = sample.position;
  for (double& position : present)
    if (!std::isfinite(position)) position = 0.0;
  Vector3d q = transmission_.jointFromMotor(present);
  for (int k = 0; k < 3; ++k) {
    if (std::isfinite(sample.position[k])) continue;
    Vector3d moved = present;
    moved[k] = 1.0;
    const Vector3d other = transmission_.jointFromMotor(moved);
    for (int joint = 0; joint < 3; ++joint)
      if (other[joint] != q[joint]) q[joint] = std::numeric_limits<double>::quiet_NaN();
  }
  return q;
}

/// Whether joint k at `q` is outside its limits and its hard stop by more than the margin.
bool MotorArrangement::isBeyond(int k, double q) const {
  const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(k)];
  const double margin = kLimitMargin * (joint.limit_high - joint.limit_low);
  return q < std::min(joint.limit_low, joint.homing) - margin ||
         q > std::max(joint.limit_high, joint.homing) + margin;
}

std::string MotorArrangement::beyondLimits(const recording::MeasuredTable& rows) const {
  const Vector3d q = jointOf(rows, Vector3d::Ones());
  std::string text;
  for (int k = 0; k < 3; ++k) {
    const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(k)];
    if (isBeyond(k, q[k]))
      text += fmt::format("by the motors, joint {} ({}) has left its limits {} to {}. ", k + 1, joint.name,
                          shown(joint, joint.limit_low), shown(joint, joint.limit_high));
  }
  return text.empty() ? text : text + kRemedy;
}

void MotorArrangement::checkLimits(const recording::MeasuredTable& rows, const Vector3d& q) const {
  for (int k = 0; k < 3; ++k) {
    const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(k)];
    if (!isBeyond(k, q[k])) continue;
    throw base::InputError(
        {rows.file,
         0,
         {},
         {},
         fmt::format("by the motors, joint {} ({}) stands at {}, outside its limits {} to {}", k + 1,
                     joint.name, shown(joint, q[k]), shown(joint, joint.limit_low),
                     shown(joint, joint.limit_high)),
         kRemedy});
  }
}

/// Radians that are read as degrees put every joint beside its hard stop, whatever the arm does. They are
/// recognised where the unconverted values give an arm inside its limits and far from there.
void MotorArrangement::checkDegrees(const recording::MeasuredTable& rows, const Vector3d& q) const {
  Vector3d factor;
  for (int k = 0; k < 3; ++k) {
    const auto unit = read_as_.of("q_m", columnOf(k + 1));
    if (unit != recording::ColumnUnit::kDegrees) return;
    factor[k] = 1.0 / recording::factorOf(*unit);
  }
  const Vector3d unconverted = jointOf(rows, factor);
  for (int k = 0; k < 3; ++k) {
    const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(k)];
    const double far = kLimitMargin * (joint.limit_high - joint.limit_low);
    if (!(unconverted[k] >= joint.limit_low && unconverted[k] <= joint.limit_high)) return;
    if (!(std::abs(unconverted[k] - joint.homing) > far)) return;
  }
  const robot::Joint& first = robot_.joints[0];
  throw base::InputError(
      {rows.file, 0, "read_as", "q_m=deg",
       fmt::format("puts every joint beside its hard stop (joint 1, {}, at {}), while the same numbers in "
                   "radians give an arm inside its limits ({})",
                   first.name, shown(first, q[0]), shown(first, unconverted[0])),
       "Leave q_m out of read_as if the rows are in radians; if they are in degrees, move the arm some "
       "degrees "
       "from the hard stop, then connect again"});
}

}  // namespace capstan::live
