#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/robot/description.h"
#include "core/session/column_units.h"
#include "core/session/measured_table.h"

namespace capstan::session {

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
///   t      median period above 0.1 s over 50 rows or more, where dq_m does not say that t is right
///   q      outside the limits by more than their range
///   q_m    beyond three times the travel that the joint limits need
///   dq_m   beyond ten times what the joints' highest speeds need; or 30 to 110 times the speed that q_m
///          shows (degrees per second would be 57 times)
///   p_c    farther from the base than three times the arm's reach
/// A unit makes a column plausible where these bounds hold then. Empty: nothing to ask. Joint columns count
/// only where the table has as many joints as the robot.
std::vector<UnitFinding> implausibleUnits(const MeasuredTable& table, const robot::Description& robot);

/// What `findings` propose, as parseReadAs() takes it: "q_m=deg,q3=mm"; columns that no unit makes plausible
/// with keep.
std::string proposedReadAs(const MeasuredTable& table, const std::vector<UnitFinding>& findings);

/// A table that is not read before a person has said what its units are. what() names columns, values and the
/// option that reads them.
class ImplausibleUnits : public base::InputError {
 public:
  ImplausibleUnits(const MeasuredTable& table, std::vector<UnitFinding> findings);
  const std::vector<UnitFinding>& findings() const { return findings_; }
  const std::string& file() const { return fault().file; }

 private:
  std::vector<UnitFinding> findings_;
};

/// Reads columns of `table` as `read_as` says. Throws ImplausibleUnits where an implausible column is left of
/// which nothing was said, and base::InputError as readColumnsAs().
void settleUnits(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as);

/// What is odd about units, and no reason to stop: a median period below 1e-4 s. Lines without the file's
/// name.
std::vector<std::string> unitNotices(const MeasuredTable& table);

}  // namespace capstan::session
