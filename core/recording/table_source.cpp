#include "core/recording/table_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "core/base/error.h"
#include "core/base/nan.h"
#include "core/recording/own_kinematics.h"
#include "core/recording/read_table.h"
#include "core/recording/session_source.h"
#include "core/recording/settle_units.h"
#include "core/ros1/bag_source.h"

namespace capstan::recording {
namespace {

Eigen::Vector3d rowOf(const TableColumns& columns, std::size_t row) {
  if (columns.empty()) return Eigen::Vector3d::Constant(base::kNaN);
  return {columns[0][row], columns[1][row], columns[2][row]};
}

}  // namespace

void checkForTracking(const MeasuredTable& table, const robot::Description& robot) {
  if (table.q_m.empty())
    refuseMissing(table, "q_m1", "is not among the columns",
                  "Add the motor positions q_m1 … q_m3 [rad, from the hard stop]: tracking starts from them");
  for (int motor = table.joints() + 1; motor <= robot.size(); ++motor)
    refuseMisspelled(table, fmt::format("q_m{}", motor));
  if (table.joints() != 3 || robot.size() != 3)
    throw base::InputError(
        {table.file,
         table.lines.header(),
         fmt::format("q_m{}", table.joints()),
         {},
         fmt::format("the table has {} joint{}, {} has {}, and tracking is made for three", table.joints(),
                     table.joints() == 1 ? "" : "s", robot.name, robot.size()),
         table.joints() == 1 ? "Choose a recording of a three-joint arm and its robot file; one drive alone "
                               "can be identified: "
                               "capstan-cli identify TABLE --robot FILE"
         : table.joints() == 2 ? "Add the column q_m3, or choose a recording of a three-joint arm"
                               : "Choose a recording of a three-joint arm and its robot file"});
}

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
  info_.notices = noticesOf(table_);
  if (table_.own_kinematics || !isOwnKinematics(table_, robot)) return;
  info_.own_kinematics = true;
  info_.notices.push_back(
      fmt::format("{}: q1, q2, q3 follow from the motor positions by {} to {} deg and mm: taken as the "
                  "robot's own kinematics, no truth",
                  table_.file, robot.name, kSameAngle));
}

std::vector<std::string> noticesOf(const MeasuredTable& table) {
  std::vector<std::string> notices;
  for (const std::string& line : unitNotices(table)) notices.push_back(table.file + ": " + line);
  if (table.ignored.empty()) return notices;
  constexpr std::size_t kMost = 20;  // names in a notice
  std::vector<std::string> unused;
  for (const std::string& name : table.ignored) {
    if (unused.size() == kMost) {
      unused.push_back(fmt::format("and {} more", table.ignored.size() - kMost));
      break;
    }
    const std::string meant = columnMeantBy(table, name);
    unused.push_back(meant.empty() ? name : fmt::format("{} (rename it, if it is {})", name, meant));
  }
  notices.push_back(fmt::format("{}: columns not used: {}", table.file, fmt::join(unused, ", ")));
  return notices;
}

bool RowSamples::next(const MeasuredTable& table, tracking::Sample& out) {
  for (; row_ < table.rows(); ++row_, part_ = 0) {
    const double t = table.t[row_];
    while (part_ < 3) {
      const int part = part_++;
      const Eigen::Vector3d value = rowOf(part == 0 ? table.q_m : part == 1 ? table.q : table.p_c, row_);
      const auto finite = value.array().isFinite();
      if (part == 0 ? !finite.any() : !finite.all()) continue;
      if (part == 0) out = tracking::MotorSample{t, value, rowOf(table.dq_m, row_), rowOf(table.tau_m, row_)};
      if (part == 1) out = tracking::JointSample{t, value};
      if (part == 2) out = tracking::TipSample{t, t, value};
      return true;
    }
  }
  return false;
}

bool TableSource::next(tracking::Sample& out) {
  if (!samples_.next(table_, out)) return false;
  if (auto* tip = std::get_if<tracking::TipSample>(&out); tip && blocked_)
    tip->position.setConstant(base::kNaN);
  return true;
}

std::unique_ptr<tracking::Source> openRecording(const std::filesystem::path& path,
                                                const robot::Description& robot, const ReadAs& read_as) {
  if (isSession(path)) return std::make_unique<SessionSource>(path);
  if (isBag(path)) return ros1::openBag(path, robot);
  return std::make_unique<TableSource>(path, robot, read_as);
}

}  // namespace capstan::recording
