#include "core/recording/unit_bounds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/robot/kinematics.h"
#include "core/robot/transmission.h"
#include "core/stats/quantile.h"

namespace capstan::recording {
namespace {

using robot::JointVector;

constexpr double kShare = 0.01;  ///< share of a column's values that may be glitches

JointVector limits(const robot::Description& robot, double robot::Joint::*limit) {
  JointVector values(robot.size());
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values(i) = robot.joints[static_cast<std::size_t>(i)].*limit;
  return values;
}

/// Range of each component of `map` over a grid on the box `low` … `high` with `steps` ≥ 2 points per
/// component. For a linear map 2 steps suffice, because its extremes are at the corners.
template <class Map>
std::vector<Range> rangesOver(const JointVector& low, const JointVector& high, int steps, Map&& map) {
  std::vector<Range> ranges;
  int points = 1;
  for (Eigen::Index joint = 0; joint < low.size(); ++joint) points *= steps;
  for (int point = 0; point < points; ++point) {
    JointVector at = low;
    for (int joint = 0, rest = point; joint < low.size(); ++joint, rest /= steps)
      at(joint) += (high(joint) - low(joint)) * (rest % steps) / (steps - 1);
    const auto value = map(at);
    for (Eigen::Index i = 0; i < value.size(); ++i) {
      if (point == 0) ranges.push_back({value(i), value(i)});
      Range& range = ranges[static_cast<std::size_t>(i)];
      range = {std::min(range.low, value(i)), std::max(range.high, value(i))};
    }
  }
  return ranges;
}

std::vector<UnitBounds> aroundZero(const std::vector<Range>& needed, double times, std::string_view what,
                                   const char* unit) {
  std::vector<UnitBounds> bounds;
  for (const Range& usual : needed) {
    const double most = times * std::max(std::abs(usual.low), std::abs(usual.high));
    bounds.push_back(
        {usual, {-most, most}, fmt::format("the {} that joint {} needs", what, bounds.size() + 1), unit});
  }
  return bounds;
}

}  // namespace

double Range::leftBy(const Range& other) const { return std::max({low - other.low, other.high - high, 0.0}); }

Range spanOf(const std::vector<double>& column) {
  constexpr std::array kEnds = {kShare, 1.0 - kShare};
  const std::vector<double> ends = stats::quantiles(column, kEnds);
  return {ends[0], ends[1]};
}

std::vector<UnitBounds> motorPositionBounds(const robot::Description& robot) {
  const robot::Transmission transmission(robot);
  const auto travel =
      rangesOver(limits(robot, &robot::Joint::limit_low), limits(robot, &robot::Joint::limit_high), 2,
                 [&](const JointVector& q) { return transmission.motorFromJoint(q); });
  return aroundZero(travel, 3.0, "travel", "rad");
}

std::vector<UnitBounds> motorSpeedBounds(const robot::Description& robot) {
  const robot::Transmission transmission(robot);
  const JointVector speed = limits(robot, &robot::Joint::max_speed);
  const auto needed = rangesOver(
      -speed, speed, 2, [&](const JointVector& dq) { return transmission.motorVelocityFromJoint(dq); });
  return aroundZero(needed, 10.0, "speed", "rad/s");
}

std::vector<UnitBounds> jointBounds(const robot::Description& robot) {
  std::vector<UnitBounds> bounds;
  for (const robot::Joint& joint : robot.joints) {
    const Range usual{joint.limit_low, joint.limit_high};
    bounds.push_back({usual, usual.wider(usual.span()),
                      fmt::format("the range of joint {}", bounds.size() + 1),
                      joint.type == robot::JointType::kRevolute ? "rad" : "m"});
  }
  return bounds;
}

UnitBounds tipBounds(const robot::Description& robot) {
  constexpr int kSteps = 4;  // 16,384 poses of seven joints
  const robot::Chain chain(robot);
  const Range usual =
      rangesOver(limits(robot, &robot::Joint::limit_low), limits(robot, &robot::Joint::limit_high), kSteps,
                 [&](const JointVector& q) { return Eigen::Matrix<double, 1, 1>(chain.marker(q).norm()); })
          .front();
  return {usual, {usual.low / 3.0, 3.0 * usual.high}, "the arm's reach", "m"};
}

std::optional<ColumnUnit> fittingUnit(const Range& span, const UnitBounds& bounds,
                                      const std::vector<ColumnUnit>& units) {
  std::optional<ColumnUnit> best;
  double least = std::numeric_limits<double>::infinity();
  for (const ColumnUnit unit : units) {
    const Range read = span.times(factorOf(unit));
    if (bounds.leftBy(read) || bounds.usual.leftBy(read) >= least) continue;
    best = unit;
    least = bounds.usual.leftBy(read);
  }
  return best;
}

}  // namespace capstan::recording
