#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::recording {

/// Throws base::InputError for a table without q_m, and for a number of joints that is not three.
void checkForTracking(const MeasuredTable& table, const robot::Description& robot);

/// Remarks on the units of a table and on columns that are not used, with its name.
std::vector<std::string> noticesOf(const MeasuredTable& table);

/// Yields the samples of a table's rows, in order.
class RowSamples {
 public:
  /// False: no row remains. The pipeline handles motor encoders that are lost (NaN).
  bool next(const MeasuredTable& table, tracking::Sample& out);

 private:
  std::size_t row_ = 0;
  int part_ = 0;
};

/// A measured table as a source. Each row yields a motor sample, a joint sample if it has q (reference), and
/// a tip sample if it has p_c. info() has notices of the columns that are not used.
class TableSource : public tracking::Source {
 public:
  /// Throws base::InputError as readTable(), for a table without q_m, and for a number of joints that is not
  /// three.
  TableSource(const std::filesystem::path& path, const robot::Description& robot, const ReadAs& read_as = {});
  /// Creates a source from a table in SI units.
  TableSource(MeasuredTable table, const robot::Description& robot);

  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override;
  /// Blocks cameras: tip samples have no position if either side is blocked.
  void block(bool left, bool right) override { blocked_ = left || right; }

 private:
  tracking::SourceInfo info_;
  MeasuredTable table_;
  RowSamples samples_;
  bool blocked_ = false;
};

/// Opens a session file, a ROS bag, a RAVEN-II motor recording (raven_motors.h) or a measured table. `robot`
/// is used for recordings without a robot, `read_as` for the units of tables. Throws ImplausibleUnits and
/// other base::InputError as readTable().
std::unique_ptr<tracking::Source> openRecording(const std::filesystem::path& path,
                                                const robot::Description& robot, const ReadAs& read_as = {});

}  // namespace capstan::recording
