#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::recording {

/// A measured table as a source: each row gives a motor sample, a joint sample where q is there (reference
/// fitted), and a tip sample where p_c is there. Columns that were not used come as notices of info().
class TableSource : public tracking::Source {
 public:
  /// Throws base::InputError as readTable() does, and for a table without q_m or whose number of joints is
  /// not the robot's three.
  TableSource(const std::filesystem::path& path, const robot::Description& robot, const ReadAs& read_as = {});
  /// A table in SI units.
  TableSource(MeasuredTable table, const robot::Description& robot);

  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override;
  /// Either side blocked: tip samples without position.
  void block(bool left, bool right) override { blocked_ = left || right; }

 private:
  tracking::SourceInfo info_;
  MeasuredTable table_;
  std::size_t row_ = 0;
  int part_ = 0;
  bool blocked_ = false;
};

/// Opens whatever `path` is: a session file, a RAVEN-II motor recording (raven_motors.h), a measured table.
/// `robot` is for recordings that bring none, `read_as` for the units of tables. Throws ImplausibleUnits and
/// other base::InputError as readTable().
std::unique_ptr<tracking::Source> openRecording(const std::filesystem::path& path,
                                                const robot::Description& robot, const ReadAs& read_as = {});

}  // namespace capstan::recording
