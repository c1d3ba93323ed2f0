#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/recording/plausibility.h"
#include "core/robot/description.h"

namespace capstan::recording {

/// Units proposed by `findings`, in the format of parseReadAs(): "q_m=deg,q3=mm". Columns that no unit makes
/// plausible get "keep".
std::string proposedReadAs(const MeasuredTable& table, const std::vector<UnitFinding>& findings);

/// Error for a table whose units the user must state first. what() names columns, values and the option for
/// reading them.
class ImplausibleUnits : public base::InputError {
 public:
  ImplausibleUnits(const MeasuredTable& table, std::vector<UnitFinding> findings);
  const std::vector<UnitFinding>& findings() const { return findings_; }
  const std::string& file() const { return fault().file; }

 private:
  std::vector<UnitFinding> findings_;
};

/// Converts columns of `table` from the units in `read_as`. Throws ImplausibleUnits if a column without a
/// stated unit is implausible. Throws base::InputError as readColumnsAs(), and if a column is implausible in
/// its stated unit or becomes implausible through the unit of another column.
void settleUnits(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as);

/// Remarks on unusual units that are no errors: a median period below 1e-4 s. Lines without the file's name.
std::vector<std::string> unitNotices(const MeasuredTable& table);

}  // namespace capstan::recording
