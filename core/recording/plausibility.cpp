#include "core/recording/plausibility.h"

#include <fmt/format.h>

#include <cmath>

#include "core/recording/motor_speeds.h"
#include "core/recording/unit_bounds.h"

namespace capstan::recording {
namespace {

constexpr std::size_t kFewestRows = 50;  ///< smallest number of rows for a rate
constexpr double kSlowestRate = 10.0;    ///< slower rates cannot resolve cable dynamics [1/s]
constexpr double kFastestRate = 1e5;     ///< no motor is sampled faster [1/s]

/// "2 … 5 rad"; a column that does not move: "2 rad".
std::string rangeText(const Range& range, const char* unit) {
  const std::string low = fmt::format("{:.4g}", range.low), high = fmt::format("{:.4g}", range.high);
  return fmt::format("{}{}{}", low == high ? low : low + " … " + high, *unit == '\0' ? "" : " ", unit);
}

std::string spanText(const Range& span) {
  const std::string range = rangeText(span, "");
  return (range.find("…") == std::string::npos ? "is " : "spans ") + range;
}

std::string readText(const Range& span, const UnitBounds& bounds, std::optional<ColumnUnit> unit) {
  if (!unit) return "; no other unit is plausible";
  const Range read = span.times(factorOf(*unit));
  return fmt::format("; in {} it is {}, {}", wordOf(*unit), rangeText(read, bounds.unit),
                     bounds.usual.leftBy(read) > 0.0 ? "which is nearer" : "which is within it");
}

/// Examines a table column by column.
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
  /// Possible units; degrees also for a sliding joint, because some tables convert all joints in the same
  /// way.
  std::vector<ColumnUnit> unitsOf(std::size_t joint) const {
    using enum ColumnUnit;
    return turns(joint) ? std::vector{kDegrees} : std::vector{kMillimetres, kCentimetres, kDegrees};
  }
  std::vector<ColumnUnit> unitsOf(const UnitFinding& found) const {
    if (found.quantity == "q") return unitsOf(std::stoul(found.column.substr(1)) - 1);
    for (const UnitQuantity& quantity : unitQuantities())
      if (quantity.name == found.quantity) return quantity.units;
    return {};
  }
  bool turns(std::size_t joint) const { return robot_.joints[joint].type == robot::JointType::kRevolute; }

  UnitFinding finding(std::string_view quantity, std::size_t i, const Range& span) const {
    return {
        fmt::format("{}{}", quantity, i + 1), std::string(quantity), span.low, span.high, true, {}, {}, {}};
  }

  /// Finding for a column outside its bounds.
  std::optional<UnitFinding> outside(std::string_view quantity, std::size_t i,
                                     const std::vector<double>& column, const UnitBounds& bounds,
                                     const std::vector<ColumnUnit>& units) const {
    const Range span = spanOf(column);
    if (!bounds.leftBy(span)) return std::nullopt;
    UnitFinding found = finding(quantity, i, span);
    found.unit = fittingUnit(span, bounds, units);
    found.text = fmt::format("{}: as {} it would leave {}, {}, by {:.4g} {}{}", spanText(span), bounds.unit,
                             bounds.what, rangeText(bounds.usual, bounds.unit), bounds.usual.leftBy(span),
                             bounds.unit, readText(span, bounds, found.unit));
    return found;
  }

  /// Adds the columns of one quantity that `find` finds implausible, and the other columns that share the
  /// unit of the first of these: those for which `sharing(column, first)` is true.
  template <class Find, class Sharing>
  void addQuantity(std::string_view quantity, const TableColumns& columns, Find&& find, Sharing&& sharing) {
    std::vector<std::optional<UnitFinding>> found(columns.size());
    std::optional<std::size_t> first;
    std::string name_of_first;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      found[i] = find(i);
      if (found[i] && found[i]->unit && !first && sharing(i, i)) first = i, name_of_first = found[i]->column;
    }
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!found[i] && first && sharing(i, *first)) {
        const Range span = spanOf(columns[i]);
        if (std::isnan(span.low)) continue;
        found[i] = finding(quantity, i, span);
        found[i]->implausible = false;
        found[i]->unit = found[*first]->unit;
        found[i]->text =
            fmt::format("{}: plausible by itself, but {} has the same unit", spanText(span), name_of_first);
      }
      if (found[i]) findings_.push_back(std::move(*found[i]));
    }
  }

  void time() {
    const double period = medianPeriod(table_);
    if (table_.rows() < kFewestRows) return;
    if (period > 1.0 / kSlowestRate) slowRows(period);
    if (period > 0.0 && period < 1.0 / kFastestRate)
      addTime(
          fmt::format("has rows every {:.4g}: in seconds this is faster than any motor is sampled", period),
          {});
  }

  /// Tests the unit of t: such slow rows are in another unit, unless dq_m shows that t is correct.
  void slowRows(double period) {
    const MotorSpeeds speeds(table_, MotorFactors(table_.q_m.size(), 1.0), 1.0);
    if (speeds.any() && speeds.agree()) return;
    std::string text =
        fmt::format("has rows every {:.4g}: in seconds this is slower than any motor is sampled", period);
    std::optional<ColumnUnit> read_as;
    for (const ColumnUnit unit :
         {ColumnUnit::kNanoseconds, ColumnUnit::kMicroseconds, ColumnUnit::kMilliseconds})
      if (factorOf(unit) * period <= 1.0 / kSlowestRate) read_as = unit;
    if (read_as)
      text += fmt::format("; in {} there are {:.4g} rows per second", wordOf(*read_as),
                          1.0 / (factorOf(*read_as) * period));
    addTime(std::move(text), read_as);
  }

  void addTime(std::string text, std::optional<ColumnUnit> unit) {
    findings_.push_back({"t", "t", table_.t.front(), table_.t.back(), true, unit, {}, std::move(text)});
  }

  void motors() {
    const auto bounds = motorPositionBounds(robot_);
    const auto find = [&](std::size_t i) {
      return outside("q_m", i, table_.q_m[i], bounds[i], {ColumnUnit::kDegrees});
    };
    addQuantity("q_m", table_.q_m, find,
                [this](std::size_t i, std::size_t because) { return !shownInSi(i, because); });
  }

  /// True if motor i is in SI although motor `because` is in degrees: the unconverted speeds of i agree with
  /// its positions, and those of `because` agree with its positions in radians.
  bool shownInSi(std::size_t i, std::size_t because) const {
    const auto agree = [](double ratio) { return ratio > 1.0 / 3.0 && ratio < 3.0; };
    const MotorSpeeds stand(table_, MotorFactors(table_.q_m.size(), 1.0), factorFound("t"));
    const MotorSpeeds read(table_, MotorFactors(table_.q_m.size(), factorOf(ColumnUnit::kDegrees)),
                           factorFound("t"));
    return agree(stand.ratio(i)) && agree(read.ratio(because));
  }

  /// Factor to SI of a column by the findings so far.
  double factorFound(std::string_view column) const {
    for (const UnitFinding& found : findings_)
      if (found.column == column) return factorOf(found.unit.value_or(ColumnUnit::kSi));
    return 1.0;
  }

  void motorSpeeds() {
    const auto bounds = motorSpeedBounds(robot_);
    MotorFactors positions;
    for (std::size_t i = 0; i < table_.q_m.size(); ++i)
      positions.push_back(factorFound(fmt::format("q_m{}", i + 1)));
    const MotorSpeeds shown(table_, positions, factorFound("t"));
    const auto find = [&](std::size_t i) {
      auto found = outside("dq_m", i, table_.dq_m[i], bounds[i], {ColumnUnit::kDegrees});
      if (found || !shown.inDegrees(i)) return found;
      const Range span = spanOf(table_.dq_m[i]);
      found = finding("dq_m", i, span);
      found->unit = ColumnUnit::kDegrees;
      found->text =
          fmt::format("{}: in rad/s this is {:.3g} times the rate of q_m{}; in degrees per second they agree",
                      spanText(span), shown.ratio(i), i + 1);
      return found;
    };
    addQuantity("dq_m", table_.dq_m, find,
                [&](std::size_t i, std::size_t) { return !(shown.ratio(i) < 30.0); });
  }

  void joints() {
    const auto bounds = jointBounds(robot_);
    const auto find = [&](std::size_t i) { return outside("q", i, table_.q[i], bounds[i], unitsOf(i)); };
    addQuantity("q", table_.q, find, [this](std::size_t i, std::size_t) { return turns(i); });
  }

  void tip() {
    if (table_.p_c.empty()) return;
    std::vector<double> distance(table_.rows());
    for (std::size_t row = 0; row < distance.size(); ++row)
      distance[row] = std::hypot(table_.p_c[0][row], table_.p_c[1][row], table_.p_c[2][row]);
    const Range far = spanOf(distance);
    const UnitBounds bounds = tipBounds(robot_);
    if (!bounds.leftBy(far)) return;
    using enum ColumnUnit;
    const std::optional<ColumnUnit> unit = fittingUnit(far, bounds, {kMillimetres, kCentimetres});
    for (std::size_t i = 0; i < table_.p_c.size(); ++i) {
      const Range span = spanOf(table_.p_c[i]);
      UnitFinding found = finding("p_c", i, span);
      found.unit = unit;
      found.text = fmt::format("{}, the tip {} from the base: as m it would leave {}, {}{}", spanText(span),
                               rangeText(far, ""), bounds.what, rangeText(bounds.usual, "m"),
                               readText(far, bounds, unit));
      findings_.push_back(std::move(found));
    }
  }

  const MeasuredTable& table_;
  const robot::Description& robot_;
  std::vector<UnitFinding> findings_;
};

}  // namespace

std::vector<UnitFinding> implausibleUnits(const MeasuredTable& table, const robot::Description& robot) {
  return Inspection(table, robot).all();
}

}  // namespace capstan::recording
