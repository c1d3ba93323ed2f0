#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// A column whose values are implausible in SI units, or a neighbour that shares its unit.
struct UnitFinding {
  std::string column;              ///< "q_m1"
  std::string quantity;            ///< "q_m"
  double low = 0.0;                ///< lowest value without conversion, except 1 % of the values
  double high = 0.0;               ///<
  bool implausible = true;         ///< false: the column itself is plausible
  std::optional<ColumnUnit> unit;  ///< unit in which the column is plausible; none: no unit
  std::vector<ColumnUnit> units;   ///< possible units of such a column besides SI
  std::string text;                ///< description of the finding without the column's name
};

/// Columns of `table` whose values are implausible for `robot` in SI units, with neighbours of the same
/// quantity and unit. A column is implausible if more than 1 % of its values are out of bounds:
/// - t (only tables of 50 rows or more): median period below 1e-5 s, or above 0.1 s unless dq_m shows that t
///   is correct
/// - q: outside the joint limits by more than their range
/// - q_m: beyond three times the travel that the joint limits need
/// - dq_m: beyond ten times what the highest joint speeds need, or 30 to 110 times the rate of q_m (degrees
///   per second are 57 times)
/// - p_c: |p_c| below 1/3 of the smallest or above 3 times the largest distance from the base that the joint
///   limits allow
///
/// A unit makes a column plausible if these bounds hold after conversion. Neighbours of an implausible column
/// share its unit, except motors whose unconverted q_m and dq_m agree while dq_m is in SI. Empty: all columns
/// are plausible. Joint columns are tested only if the table has as many joints as the robot.
std::vector<UnitFinding> implausibleUnits(const MeasuredTable& table, const robot::Description& robot);

}  // namespace capstan::recording
