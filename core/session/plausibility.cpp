#include "core/session/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/robot/transmission.h"

namespace capstan::session {
namespace {

using robot::JointVector;

struct Range {
  double low, high;
  double span() const { return high - low; }
  Range wider(double by) const { return {low - by, high + by}; }
};

/// The value of `column` farthest outside `range`; NaN: none is.
double farthestOutside(const std::vector<double>& column, const Range& range) {
  double farthest = std::numeric_limits<double>::quiet_NaN(), most = 0.0;
  for (const double value : column) {
    const double beyond = std::max(range.low - value, value - range.high);
    if (!(beyond > most)) continue;
    most = beyond;
    farthest = value;
  }
  return farthest;
}

/// `map` of every corner of the box `low` … `high`: the range of each component. A linear map is extreme
/// there.
template <class Map>
std::vector<Range> rangesOver(const JointVector& low, const JointVector& high, Map&& map) {
  std::vector<Range> ranges;
  for (unsigned corner = 0; corner < 1U << low.size(); ++corner) {
    JointVector at = low;
    for (Eigen::Index joint = 0; joint < low.size(); ++joint)
      if (corner >> joint & 1U) at(joint) = high(joint);
    const JointVector value = map(at);
    ranges.resize(static_cast<std::size_t>(value.size()), {value(0), value(0)});
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double here = value(static_cast<Eigen::Index>(i));
      ranges[i] = corner == 0 ? Range{here, here}
                              : Range{std::min(ranges[i].low, here), std::max(ranges[i].high, here)};
    }
  }
  return ranges;
}

class Doubts {
 public:
  Doubts(const MeasuredTable& table, const robot::Description& robot) : table_(table), robot_(robot) {}

  std::vector<std::string> all() {
    time();
    if (table_.joints() == robot_.size()) {
      joints();
      motors();
    }
    tip();
    return std::move(lines_);
  }

 private:
  void add(const std::string& text) { lines_.push_back(table_.file + ": " + text); }

  void time() {
    if (table_.rows() < 2) return;
    std::vector<double> periods(table_.rows() - 1);
    for (std::size_t row = 0; row < periods.size(); ++row) periods[row] = table_.t[row + 1] - table_.t[row];
    const auto middle = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
    std::nth_element(periods.begin(), middle, periods.end());
    if (*middle > 0.1) add(fmt::format("sample period {:.4g} s: is t in milliseconds?", *middle));
    if (*middle < 1e-4) add(fmt::format("sample period {:.4g} s: is t not in seconds?", *middle));
  }

  void joints() {
    for (std::size_t i = 0; i < table_.q.size(); ++i) {
      const robot::Joint& joint = robot_.joints[i];
      const Range limits{joint.limit_low, joint.limit_high};
      const double value = farthestOutside(table_.q[i], limits.wider(limits.span()));
      if (std::isnan(value)) continue;
      const bool turns = joint.type == robot::JointType::kRevolute;
      add(fmt::format("q{} = {:.4g} lies outside {:.4g}…{:.4g} {}: are these {}?", i + 1, value, limits.low,
                      limits.high, turns ? "rad" : "m", turns ? "degrees" : "millimetres"));
    }
  }

  void motors() {
    const robot::Transmission transmission(robot_);
    JointVector low(robot_.size()), high(robot_.size()), speed(robot_.size());
    for (Eigen::Index i = 0; i < low.size(); ++i) {
      const robot::Joint& joint = robot_.joints[static_cast<std::size_t>(i)];
      low(i) = joint.limit_low;
      high(i) = joint.limit_high;
      speed(i) = joint.max_speed;
    }
    const auto travel =
        rangesOver(low, high, [&](const JointVector& q) { return transmission.motorFromJoint(q); });
    const auto speeds = rangesOver(
        -speed, speed, [&](const JointVector& dq) { return transmission.motorVelocityFromJoint(dq); });
    compare(table_.q_m, "q_m", "rad", "degrees", travel, 3.0);
    compare(table_.dq_m, "dq_m", "rad/s", "degrees per second", speeds, 10.0);
  }

  void compare(const TableColumns& columns, const char* name, const char* unit, const char* instead,
               const std::vector<Range>& needed, double times) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const double most = times * std::max(std::abs(needed[i].low), std::abs(needed[i].high));
      const double value = farthestOutside(columns[i], {-most, most});
      if (!std::isnan(value))
        add(fmt::format("{}{} = {:.4g} lies far outside the {:.4g}…{:.4g} {} of this robot: are these {}?",
                        name, i + 1, value, needed[i].low, needed[i].high, unit, instead));
    }
  }

  void tip() {
    double reach = robot_.marker.norm();
    for (const robot::Joint& joint : robot_.joints) {
      reach += std::abs(joint.dh.a) + std::abs(joint.dh.d);
      if (joint.type == robot::JointType::kPrismatic)
        reach += std::max(std::abs(joint.limit_low), std::abs(joint.limit_high));
    }
    for (std::size_t i = 0; i < table_.p_c.size(); ++i) {
      const double value = farthestOutside(table_.p_c[i], {-3.0 * reach, 3.0 * reach});
      if (!std::isnan(value))
        add(fmt::format("p_c{} = {:.4g} lies beyond the arm's reach of {:.2g} m: are these millimetres?",
                        i + 1, value, reach));
    }
  }

  const MeasuredTable& table_;
  const robot::Description& robot_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> unitDoubts(const MeasuredTable& table, const robot::Description& robot) {
  return Doubts(table, robot).all();
}

}  // namespace capstan::session
