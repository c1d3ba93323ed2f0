#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// A column that a robot can hardly have measured in SI units, or one beside it that shares its unit.
struct UnitFinding {
  std::string column;              ///< "q_m1"
  std::string quantity;            ///< "q_m"
  double low = 0.0;                ///< what the column spans, but for 1 % of its values, as they stand
  double high = 0.0;               ///<
  bool implausible = true;         ///< false: plausible by itself
  std::optional<ColumnUnit> unit;  ///< that makes it plausible; none: no unit does
  std::vector<ColumnUnit> units;   ///< that such a column may have besides SI
  std::string text;                ///< what was found, a sentence without the column's name
};

/// The columns of `table` whose numbers `robot` can hardly have given in SI units, with their neighbours of
/// the same quantity and unit. A column is implausible where more than 1 % of its values are:
///   t      over 50 rows or more, median period below 1e-5 s, or above 0.1 s where dq_m does not show t to be
///   right q      outside the limits by more than their range q_m    beyond three times the travel that the
///   joint limits need dq_m   beyond ten times what the joints' highest speeds need; or 30 to 110 times the
///   speed that q_m
///          shows (degrees per second would be 57 times)
///   p_c    |p_c| below a third of the least, or above three times the greatest, distance from the base
///   within the
///          joint limits
/// A unit makes a column plausible where these bounds hold then. Neighbours of an implausible column share
/// its unit, but for motors whose q_m agrees with dq_m as both stand, where dq_m is in SI. Empty: nothing to
/// ask. Joint columns count only where the table has as many joints as the robot.
std::vector<UnitFinding> implausibleUnits(const MeasuredTable& table, const robot::Description& robot);

}  // namespace capstan::recording
