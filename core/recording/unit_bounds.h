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
  /// Largest distance by which `other` exceeds this range at either end.
  double leftBy(const Range& other) const;
};

/// Range of a column without 1 % of its values at either end, which may be glitches; NaN for an empty column.
Range spanOf(const std::vector<double>& column);

/// Plausible range of a column in SI units.
struct UnitBounds {
  Range usual;       ///< range that the robot needs
  Range widest;      ///< range outside which a column is implausible
  std::string what;  ///< meaning of `usual`, e.g. "the travel that joint 1 needs"
  const char* unit;  ///< SI unit

  bool leftBy(const Range& span) const { return widest.leftBy(span) > 0.0; }
};

/// Bounds of q_m, one element per motor: widest is three times the travel that the joint limits need.
std::vector<UnitBounds> motorPositionBounds(const robot::Description& robot);
/// Bounds of dq_m: widest is ten times what the joints' highest speeds need.
std::vector<UnitBounds> motorSpeedBounds(const robot::Description& robot);
/// Bounds of q: widest is the joint limits, extended by their range on either side.
std::vector<UnitBounds> jointBounds(const robot::Description& robot);
/// Bounds of the tip's distance from the base, |p_c|: usual is the range within the joint limits; widest is
/// from 1/3 of its minimum to 3 times its maximum.
UnitBounds tipBounds(const robot::Description& robot);

/// The one of `units` in which `span` is nearest to the usual range; none: it is outside the widest range in
/// all of them.
std::optional<ColumnUnit> fittingUnit(const Range& span, const UnitBounds& bounds,
                                      const std::vector<ColumnUnit>& units);

}  // namespace capstan::recording
