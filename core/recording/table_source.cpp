#include "core/recording/table_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <limits>

#include "core/base/error.h"
#include "core/recording/read_table.h"
#include "core/recording/session_source.h"
#include "core/recording/settle_units.h"

namespace capstan::recording {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d rowOf(const TableColumns& columns, std::size_t row) {
  if (columns.empty()) return Eigen::Vector3d::Constant(kNaN);
  return {columns[0][row], columns[1][row], columns[2][row]};
}

void checkForTracking(const MeasuredTable& table, const robot::Description& robot) {
  if (table.q_m.empty())
    throw base::InputError(
        {table.file,
         1,
         "q_m1",
         {},
         "is not among the columns",
         "Add the motor positions q_m1 … q_m3 [rad, from the hard stop]: tracking starts from them"});
  if (table.joints() != 3 || robot.size() != 3)
    throw base::InputError(
        {table.file,
         1,
         fmt::format("q_m{}", table.joints()),
         {},
         fmt::format("the table has {} joint{}, {} has {}, and tracking is made for three", table.joints(),
                     table.joints() == 1 ? "" : "s", robot.name, robot.size()),
         table.joints() == 1 ? "Choose a recording of a three-joint arm and its robot file; one drive alone "
                               "can be identified: "
                               "capstan-cli identify TABLE --robot FILE"
                             : "Choose a recording of a three-joint arm and its robot file"});
}

}  // namespace

TableSource::TableSource(const std::filesystem::path& path, const robot::Description& robot,
                         const ReadAs& read_as)
    : TableSource(readTable(path, robot, read_as), robot) {
  if (!read_as.empty())
    info_.notices.push_back(fmt::format("{}: read as {}", table_.file, formatReadAs(read_as)));
}

TableSource::TableSource(MeasuredTable table, const robot::Description& robot) : table_(std::move(table)) {
  checkForTracking(table_, robot);
  info_.title = std::filesystem::path(table_.file).filename().string();
  info_.robot = robot;
  info_.begin = table_.t.front();
  info_.duration = table_.t.back() - table_.t.front();
  info_.reference = !table_.q.empty();
  info_.own_kinematics = table_.own_kinematics;
  for (const std::string& line : unitNotices(table_)) info_.notices.push_back(table_.file + ": " + line);
  if (!table_.ignored.empty())
    info_.notices.push_back(
        fmt::format("{}: columns not used: {}", table_.file, fmt::join(table_.ignored, ", ")));
}

bool TableSource::next(tracking::Sample& out) {
  for (; row_ < table_.rows(); ++row_, part_ = 0) {
    const double t = table_.t[row_];
    while (part_ < 3) {
      const int part = part_++;
      const Eigen::Vector3d value = rowOf(part == 0 ? table_.q_m : part == 1 ? table_.q : table_.p_c, row_);
      const auto finite = value.array().isFinite();
      if (part == 0 ? !finite.any() : !finite.all()) continue;  // the pipeline handles lost motor encoders
      if (part == 0)
        out = tracking::MotorSample{t, value, rowOf(table_.dq_m, row_), rowOf(table_.tau_m, row_)};
      if (part == 1) out = tracking::JointSample{t, value};
      if (part == 2)
        out = tracking::TipSample{t, t, blocked_ ? Eigen::Vector3d::Constant(kNaN).eval() : value};
      return true;
    }
  }
  return false;
}

std::unique_ptr<tracking::Source> openRecording(const std::filesystem::path& path,
                                                const robot::Description& robot, const ReadAs& read_as) {
  if (isSession(path)) return std::make_unique<SessionSource>(path);
  return std::make_unique<TableSource>(path, robot, read_as);
}

}  // namespace capstan::recording
