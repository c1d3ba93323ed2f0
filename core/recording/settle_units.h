#pragma once

#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/recording/plausibility.h"
#include "core/robot/description.h"

namespace capstan::recording {

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
/// which nothing was said; base::InputError as readColumnsAs(), and where a column is implausible in the unit
/// that was stated of it, or becomes so beside one.
void settleUnits(MeasuredTable& table, const robot::Description& robot, const ReadAs& read_as);

/// What is odd about units, and no reason to stop: a median period below 1e-4 s. Lines without the file's
/// name.
std::vector<std::string> unitNotices(const MeasuredTable& table);

}  // namespace capstan::recording
