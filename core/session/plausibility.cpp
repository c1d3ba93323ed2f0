#include "core/session/plausibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/robot/transmission.h"
#include "core/session/motor_speeds.h"
#include "core/stats/quantile.h"

namespace capstan::session {
namespace {

using robot::JointVector;

constexpr double kShare = 0.01;          ///< of a column's values that may be wild: glitches are no units
constexpr std::size_t kFewestRows = 50;  ///< below which rows tell no rate
constexpr double kSlowestRate = 10.0;    ///< below which cable dynamics cannot be followed [1/s]

struct Range {
  double low, high;
  double span() const { return high - low; }
  Range wider(double by) const { return {low - by, high + by}; }
  Range times(double factor) const { return {factor * low, factor * high}; }
  /// By how much `other` sticks out.
  double leftBy(const Range& other) const { return std::max({low - other.low, other.high - high, 0.0}); }
};

/// What a column spans but for kShare of its values; NaN: it is empty.
Range spanOf(const std::vector<double>& column) {
  constexpr std::array kEnds = {kShare, 1.0 - kShare};
  const std::vector<double> ends = stats::quantiles(column, kEnds);
  return {ends[0], ends[1]};
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

/// What a column may span in SI units.
struct Bounds {
  Range usual;       ///< what the robot needs
  Range widest;      ///< beyond which a column is implausible
  std::string what;  ///< "the travel that joint 1 needs"
  const char* unit;  ///< SI
};

Bounds aroundZero(const Range& usual, double times, std::string what, const char* unit) {
  const double most = times * std::max(std::abs(usual.low), std::abs(usual.high));
  return {usual, {-most, most}, std::move(what), unit};
}

std::string_view wordOf(ColumnUnit unit) {
  switch (unit) {
    case ColumnUnit::kDegrees:
      return "degrees";
    case ColumnUnit::kMillimetres:
      return "millimetres";
    case ColumnUnit::kMilliseconds:
      return "milliseconds";
    case ColumnUnit::kMicroseconds:
      return "microseconds";
    case ColumnUnit::kNanoseconds:
      return "nanoseconds";
    case ColumnUnit::kSi:
      break;
  }
  return "SI";
}

/// Of `units` the one in which `span` lies nearest to what is usual; none: it lies beyond the widest in each.
std::optional<ColumnUnit> fitting(const Range& span, const Bounds& bounds,
                                  const std::vector<ColumnUnit>& units) {
  std::optional<ColumnUnit> best;
  double least = std::numeric_limits<double>::infinity();
  for (const ColumnUnit unit : units) {
    const Range read = span.times(factorOf(unit));
    if (bounds.widest.leftBy(read) > 0.0 || bounds.usual.leftBy(read) >= least) continue;
    best = unit;
    least = bounds.usual.leftBy(read);
  }
  return best;
}

std::string rangeText(const Range& range, const char* unit) {
  return fmt::format("{:.4g} … {:.4g} {}", range.low, range.high, unit);
}

std::string readText(const Range& span, const Bounds& bounds, std::optional<ColumnUnit> unit) {
  if (!unit) return "; in no unit that it may have does it lie within";
  return fmt::format("; as {}, {}, it lies within", wordOf(*unit),
                     rangeText(span.times(factorOf(*unit)), bounds.unit));
}

/// Looks at a table column by column.
class Inspection {
 public:
  Inspection(const MeasuredTable& table, const robot::Description& robot) : table_(table), robot_(robot) {}

  std::vector<UnitFinding> all() {
    time();
    if (table_.joints() == robot_.size()) {
      motors();
      motorSpeeds();
      joints();
    }
    tip();
    for (UnitFinding& found : findings_) found.units = unitsOf(found);
    return std::move(findings_);
  }

 private:
  /// Of a sliding joint degrees too: some tables convert all joints alike.
  std::vector<ColumnUnit> unitsOf(const UnitFinding& found) const {
    using enum ColumnUnit;
    if (found.quantity == "q") {
      const std::size_t joint = std::stoul(found.column.substr(1)) - 1;
      return turns(joint) ? std::vector{kDegrees} : std::vector{kMillimetres, kDegrees};
    }
    for (const UnitQuantity& quantity : unitQuantities())
      if (quantity.name == found.quantity) return quantity.units;
    return {};
  }
  bool turns(std::size_t joint) const { return robot_.joints[joint].type == robot::JointType::kRevolute; }

  UnitFinding finding(std::string_view quantity, std::size_t i, const Range& span) const {
    return {
        fmt::format("{}{}", quantity, i + 1), std::string(quantity), span.low, span.high, true, {}, {}, {}};
  }

  /// A column outside its bounds, as a finding.
  std::optional<UnitFinding> outside(std::string_view quantity, std::size_t i,
                                     const std::vector<double>& column, const Bounds& bounds,
                                     const std::vector<ColumnUnit>& units) const {
    const Range span = spanOf(column);
    if (!(bounds.widest.leftBy(span) > 0.0)) return std::nullopt;
    UnitFinding found = finding(quantity, i, span);
    found.unit = fitting(span, bounds, units);
    found.text = fmt::format("spans {:.4g} … {:.4g}: as {} it would leave {}, {}, by {:.4g} {}{}", span.low,
                             span.high, bounds.unit, bounds.what, rangeText(bounds.usual, bounds.unit),
                             bounds.usual.leftBy(span), bounds.unit, readText(span, bounds, found.unit));
    return found;
  }

  /// The columns of one quantity that `find` finds implausible, with the others that share their unit:
  /// those for which `sharing` is true.
  template <class Find, class Sharing>
  void addQuantity(std::string_view quantity, const TableColumns& columns, Find&& find, Sharing&& sharing) {
    std::vector<std::optional<UnitFinding>> found(columns.size());
    std::optional<ColumnUnit> shared;
    std::string because;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      found[i] = find(i);
      if (!found[i] || !found[i]->unit || !sharing(i) || shared) continue;
      shared = found[i]->unit;
      because = found[i]->column;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!found[i] && shared && sharing(i)) {
        const Range span = spanOf(columns[i]);
        if (std::isnan(span.low)) continue;
        found[i] = finding(quantity, i, span);
        found[i]->implausible = false;
        found[i]->unit = shared;
        found[i]->text = fmt::format("spans {:.4g} … {:.4g}: plausible by itself, but {} is beside it",
                                     span.low, span.high, because);
      }
      if (found[i]) findings_.push_back(std::move(*found[i]));
    }
  }

  static constexpr auto kAllShare = [](std::size_t) { return true; };

  void time() {
    const double period = medianPeriod(table_);
    if (table_.rows() < kFewestRows || !(period > 1.0 / kSlowestRate)) return;
    const MotorSpeeds speeds(table_, 1.0, 1.0);
    if (speeds.any() && speeds.agree()) return;
    UnitFinding found{"t", "t", table_.t.front(), table_.t.back(), true, {}, {}, {}};
    found.text =
        fmt::format("has rows every {:.4g}: as seconds that is slower than any motor is read", period);
    for (const ColumnUnit unit :
         {ColumnUnit::kNanoseconds, ColumnUnit::kMicroseconds, ColumnUnit::kMilliseconds})
      if (const double read = factorOf(unit) * period; read <= 1.0 / kSlowestRate) found.unit = unit;
    if (found.unit)
      found.text += fmt::format("; as {} there are {:.4g} rows a second", wordOf(*found.unit),
                                1.0 / (factorOf(*found.unit) * period));
    findings_.push_back(std::move(found));
  }

  void motors() {
    const robot::Transmission transmission(robot_);
    JointVector low(robot_.size()), high(robot_.size());
    for (Eigen::Index i = 0; i < low.size(); ++i) {
      low(i) = robot_.joints[static_cast<std::size_t>(i)].limit_low;
      high(i) = robot_.joints[static_cast<std::size_t>(i)].limit_high;
    }
    const auto travel =
        rangesOver(low, high, [&](const JointVector& q) { return transmission.motorFromJoint(q); });
    const auto find = [&](std::size_t i) {
      return outside("q_m", i, table_.q_m[i],
                     aroundZero(travel[i], 3.0, fmt::format("the travel that joint {} needs", i + 1), "rad"),
                     {ColumnUnit::kDegrees});
    };
    addQuantity("q_m", table_.q_m, find, kAllShare);
  }

  /// Factor to SI of what was found so far of a column.
  double factorFound(std::string_view column) const {
    for (const UnitFinding& found : findings_)
      if (found.column == column) return factorOf(found.unit.value_or(ColumnUnit::kSi));
    return 1.0;
  }

  void motorSpeeds() {
    const robot::Transmission transmission(robot_);
    JointVector speed(robot_.size());
    for (Eigen::Index i = 0; i < speed.size(); ++i)
      speed(i) = robot_.joints[static_cast<std::size_t>(i)].max_speed;
    const auto needed = rangesOver(
        -speed, speed, [&](const JointVector& dq) { return transmission.motorVelocityFromJoint(dq); });
    const MotorSpeeds shown(table_, factorFound("q_m1"), factorFound("t"));
    const auto find = [&](std::size_t i) {
      auto found =
          outside("dq_m", i, table_.dq_m[i],
                  aroundZero(needed[i], 10.0, fmt::format("the speeds that joint {} needs", i + 1), "rad/s"),
                  {ColumnUnit::kDegrees});
      if (found || !shown.inDegrees(i)) return found;
      const Range span = spanOf(table_.dq_m[i]);
      found = finding("dq_m", i, span);
      found->unit = ColumnUnit::kDegrees;
      found->text = fmt::format(
          "spans {:.4g} … {:.4g}: as rad/s that is {:.3g} times the speed at which q_m{} changes; as degrees "
          "per second they agree",
          span.low, span.high, shown.ratio(i), i + 1);
      return found;
    };
    addQuantity("dq_m", table_.dq_m, find, kAllShare);
  }

  void joints() {
    const auto find = [&](std::size_t i) {
      const robot::Joint& joint = robot_.joints[i];
      const Range limits{joint.limit_low, joint.limit_high};
      const Bounds bounds{limits, limits.wider(limits.span()), fmt::format("the range of joint {}", i + 1),
                          turns(i) ? "rad" : "m"};
      using enum ColumnUnit;
      return outside("q", i, table_.q[i], bounds,
                     turns(i) ? std::vector{kDegrees} : std::vector{kMillimetres, kDegrees});
    };
    addQuantity("q", table_.q, find, [this](std::size_t i) { return turns(i); });
  }

  void tip() {
    if (table_.p_c.empty()) return;
    double reach = robot_.marker.norm();
    for (const robot::Joint& joint : robot_.joints) {
      reach += std::abs(joint.dh.a) + std::abs(joint.dh.d);
      if (joint.type == robot::JointType::kPrismatic)
        reach += std::max(std::abs(joint.limit_low), std::abs(joint.limit_high));
    }
    std::vector<double> distance(table_.rows());
    for (std::size_t row = 0; row < distance.size(); ++row)
      distance[row] = std::hypot(table_.p_c[0][row], table_.p_c[1][row], table_.p_c[2][row]);
    const Range far = spanOf(distance);
    const Bounds bounds{{0.0, reach}, {0.0, 3.0 * reach}, "the arm's reach", "m"};
    if (!(bounds.widest.leftBy(far) > 0.0)) return;
    const std::optional<ColumnUnit> unit = fitting(far, bounds, {ColumnUnit::kMillimetres});
    for (std::size_t i = 0; i < table_.p_c.size(); ++i) {
      const Range span = spanOf(table_.p_c[i]);
      UnitFinding found = finding("p_c", i, span);
      found.unit = unit;
      found.text = fmt::format(
          "spans {:.4g} … {:.4g}, the tip {:.4g} from the base: as m it would leave {}, {:.4g} m, by {:.4g} "
          "m{}",
          span.low, span.high, far.high, bounds.what, reach, bounds.usual.leftBy(far),
          readText(far, bounds, unit));
      findings_.push_back(std::move(found));
    }
  }

  const MeasuredTable& table_;
  const robot::Description& robot_;
  std::vector<UnitFinding> findings_;
};

std::size_t columnsOf(const MeasuredTable& table, std::string_view name) {
  for (const UnitQuantity& quantity : unitQuantities())
    if (quantity.name == name) return quantity.columns ? (table.*quantity.columns).size() : 1;
  return 0;
}

std::string faultText(const std::vector<UnitFinding>& findings) {
  std::string text = "columns that this robot can hardly have measured in SI units. Nothing was read:";
  for (const UnitFinding& found : findings) text += fmt::format("\n  {} {}", found.column, found.text);
  return text;
}

std::string keepAll(const std::vector<UnitFinding>& findings) {
  std::string text;
  for (std::size_t i = 0; i < findings.size(); ++i)
    if (i == 0 || findings[i].quantity != findings[i - 1].quantity)
      text += fmt::format("{}{}=keep", text.empty() ? "" : ",", findings[i].quantity);
  return text;
}

}  // namespace

std::vector<UnitFinding> implausibleUnits(const MeasuredTable& table, const robot::Description& robot) {
  return Inspection(table, robot).all();
}

std::string proposedReadAs(const MeasuredTable& table, const std::vector<UnitFinding>& findings) {
  std::string text;
  const auto add = [&](const std::string& name, std::optional<ColumnUnit> unit) {
    text +=
        fmt::format("{}{}={}", text.empty() ? "" : ",", name, base::nameOf(unit.value_or(ColumnUnit::kSi)));
  };
  for (auto begin = findings.begin(); begin != findings.end();) {
    const auto end = std::find_if(
        begin, findings.end(), [&](const UnitFinding& other) { return other.quantity != begin->quantity; });
    const bool alike =
        static_cast<std::size_t>(end - begin) == columnsOf(table, begin->quantity) &&
        std::all_of(begin, end, [&](const UnitFinding& other) { return other.unit == begin->unit; });
    if (alike)
      add(begin->quantity, begin->unit);
    else
      for (auto found = begin; found != end; ++found) add(found->column, found->unit);
    begin = end;
  }
  return text;
}

ImplausibleUnits::ImplausibleUnits(const MeasuredTable& table, std::vector<UnitFinding> findings)
    : InputError({table.file,
                  0,
                  {},
                  {},
                  faultText(findings),
                  fmt::format("\nRead it with --read-as {}, or take it as it stands with --read-as {}. A "
                              "table of another robot needs its robot file",
                              proposedReadAs(table, findings), keepAll(findings))}),
      findings_(std::move(findings)) {}

void settleUnits(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as) {
  readColumnsAs(table, robot, read_as);
  std::vector<UnitFinding> findings = implausibleUnits(table, robot);
  std::erase_if(findings, [&](const UnitFinding& found) {
    return read_as.of(found.quantity, found.column).has_value();
  });
  if (std::any_of(findings.begin(), findings.end(), [](const UnitFinding& f) { return f.implausible; }))
    throw ImplausibleUnits(table, std::move(findings));
}

std::vector<std::string> unitNotices(const MeasuredTable& table) {
  const double period = medianPeriod(table);
  if (!(period < 1e-4)) return {};
  return {fmt::format("sample period {:.4g} s: is t not in seconds?", period)};
}

}  // namespace capstan::session
