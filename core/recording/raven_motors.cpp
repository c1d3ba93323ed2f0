#include "core/recording/raven_motors.h"

#include <fmt/format.h>

#include <array>
#include <map>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/robot/raven_software.h"
#include "core/table_files/csv.h"

namespace capstan::recording {
namespace {

/// Name of a column in the robot's software, its quantity and its joint.
struct RavenColumn {
  std::string_view name;
  TableColumns MeasuredTable::*quantity;
  std::size_t joint;
};

constexpr std::array kColumns = {
    RavenColumn{"mpos1_deg", &MeasuredTable::q_m, 0},
    RavenColumn{"mpos2_deg", &MeasuredTable::q_m, 1},
    RavenColumn{"mpos3_deg", &MeasuredTable::q_m, 2},
    RavenColumn{"mvel1_degps", &MeasuredTable::dq_m, 0},
    RavenColumn{"mvel2_degps", &MeasuredTable::dq_m, 1},
    RavenColumn{"mvel3_degps", &MeasuredTable::dq_m, 2},
    RavenColumn{"jpos1_deg", &MeasuredTable::q, 0},
    RavenColumn{"jpos2_deg", &MeasuredTable::q, 1},
    RavenColumn{"jpos3_m_times_57.2958", &MeasuredTable::q, 2},
    RavenColumn{"tau1", &MeasuredTable::tau_m, 0},
    RavenColumn{"tau2", &MeasuredTable::tau_m, 1},
    RavenColumn{"tau3", &MeasuredTable::tau_m, 2},
};

MeasuredTable parseRavenMotors(std::string_view text, const std::string& file) {
  MeasuredTable table;
  table.file = file;
  table.own_kinematics = true;
  for (const RavenColumn& column : kColumns) (table.*column.quantity).resize(3);
  std::map<std::string_view, bool> found;
  table_files::parseCsv(text, file, [&](std::string_view name, std::size_t) -> std::vector<double>* {
    const auto first = [&](std::string_view known) {
      if (std::exchange(found[known], true))
        throw base::InputError(
            {file, 1, std::string(name), {}, "is in the header twice", "Rename or remove one"});
    };
    if (name == "t_s") {
      first("t_s");
      return &table.t;
    }
    for (const RavenColumn& column : kColumns) {
      if (column.name != name) continue;
      first(column.name);
      return &(table.*column.quantity)[column.joint];
    }
    table.ignored.emplace_back(name);
    return nullptr;
  });
  for (const RavenColumn& column : kColumns)
    if (!found[column.name])
      throw base::InputError(
          {file,
           1,
           std::string(column.name),
           {},
           "is not among the columns",
           "Export the recording with motor and joint positions, speeds and torques of joints 1 to 3"});
  return table;
}

void checkTime(const MeasuredTable& table) {
  checkTimeRange(table);
  for (std::size_t row = 1; row < table.rows(); ++row)
    if (!(table.t[row] > table.t[row - 1]))
      throw base::InputError({table.file, static_cast<int>(row) + 2, "t_s", fmt::format("{}", table.t[row]),
                              "does not come after the line before",
                              "Sort the rows by time and remove repeated ones"});
}

}  // namespace

bool isRavenMotors(std::string_view header_line) {
  return header_line.starts_with("t_s,") && header_line.find("mpos1_deg") != std::string_view::npos;
}

MeasuredTable readRavenMotors(const std::filesystem::path& path, const robot::Description& robot) {
  if (robot.size() != 3)
    throw base::InputError(
        {path.string(),
         0,
         {},
         {},
         fmt::format("is of a three-joint arm, {} has {} joints", robot.name, robot.size()),
         "Choose the robot file of a RAVEN-II"});
  MeasuredTable table = parseRavenMotors(base::readTextFile(path), path.string());
  checkTime(table);
  const robot::RavenSoftware software(robot);
  for (std::size_t joint = 0; joint < 3; ++joint) {
    const int motor = static_cast<int>(joint);
    for (double& angle : table.q_m[joint]) angle = software.motorPosition(motor, angle);
    for (double& speed : table.dq_m[joint]) speed = software.motorSpeed(motor, speed);
    for (double& position : table.q[joint]) position = robot::RavenSoftware::joint(position);
  }
  return table;
}

}  // namespace capstan::recording
