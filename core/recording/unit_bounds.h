#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_units.h"
#include "core/robot/description.h"

namespace capstan::recording {

struct Range {
  double low, high;

  double span() const { return high - low; }
  Range wider(double by) const { return {low - by, high + by}; }
  Range times(double factor) const { return {factor * low, factor * high}; }
  /// By how much `other` sticks out.
  double leftBy(const Range& other) const;
};

/// What a column spans but for 1 % of its values at either end, which may be glitches; NaN: it is empty.
Range spanOf(const std::vector<double>& column);

/// What a column may span in SI units.
struct UnitBounds {
  Range usual;       ///< what the robot needs
  Range widest;      ///< beyond which a column is implausible
  std::string what;  ///< "the travel that joint 1 needs"
  const char* unit;  ///< SI

  bool leftBy(const Range& span) const { return widest.leftBy(span) > 0.0; }
};

/// Bounds of q_m, an element a motor: widest is three times the travel that the joint limits need.
std::vector<UnitBounds> motorPositionBounds(const robot::Description& robot);
/// Bounds of dq_m: widest is ten times what the joints' highest speeds need.
std::vector<UnitBounds> motorSpeedBounds(const robot::Description& robot);
/// Bounds of q: widest is the joint limits, wider by their range to either side.
std::vector<UnitBounds> jointBounds(const robot::Description& robot);
/// Bounds of the tip's distance from the base, |p_c|: usual is what it is within the joint limits, widest a
/// third of the least to three times the greatest.
UnitBounds tipBounds(const robot::Description& robot);

/// Of `units` the one in which `span` lies nearest to what is usual; none: it lies beyond the widest in each.
std::optional<ColumnUnit> fittingUnit(const Range& span, const UnitBounds& bounds,
                                      const std::vector<ColumnUnit>& units);

}  // namespace capstan::recording
