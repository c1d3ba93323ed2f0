#include "app/cli/recordings.h"

#include <filesystem>
#include <fstream>

#include "app/cli/console.h"
#include "core/base/error.h"
#include "core/recording/raven_motors.h"
#include "core/recording/recording_kinds.h"
#include "core/recording/session_file.h"
#include "core/recording/session_source.h"
#include "core/recording/settle_units.h"
#include "core/recording/source_table.h"
#include "core/recording/table_source.h"
#include "core/ros1/bag_source.h"
#include "core/table_files/csv.h"

namespace capstan::cli {

RecordingFormat detectFormat(const std::string& file) {
  std::error_code fault;
  const std::string suffix = std::filesystem::path(file).extension().string();
  if (suffix == recording::kSessionSuffix && std::filesystem::is_regular_file(file, fault))
    return RecordingFormat::kSession;  // not opened here: closing the file would release SQLite's locks on it
  std::ifstream in(file, std::ios::binary);
  const bool folder = std::filesystem::is_directory(file, fault);
  if (!in || folder)
    refuseFile(file,
               folder                                 ? "is a folder"
               : std::filesystem::exists(file, fault) ? "cannot be read"
                                                      : "does not exist",
               "Give a " + recording::recordingKinds() + ", or a robot file (.yaml)");
  char magic[16] = {};
  in.read(magic, sizeof magic);
  if (std::string(magic, 15) == "SQLite format 3") return RecordingFormat::kSession;
  if (ros1::isBag(magic)) return RecordingFormat::kBag;
  in.clear();
  in.seekg(0);
  std::string first(1024, '\0');
  in.read(first.data(), static_cast<std::streamsize>(first.size()));
  if (recording::isRavenMotors(table_files::csvHeaderLine(first))) return RecordingFormat::kRavenMotors;
  if (suffix == ".yaml" || suffix == ".yml") return RecordingFormat::kRobot;
  return RecordingFormat::kTable;
}

RecordingFormat formatOf(const std::string& name, const std::string& file) {
  const RecordingFormat found = detectFormat(file);
  if (name == "session") return RecordingFormat::kSession;
  if (name == "table") return RecordingFormat::kTable;
  if (name == "raven") return RecordingFormat::kRavenMotors;
  return found;
}

void addTopics(CLI::App& command, std::string& topics) {
  command
      .add_option(
          kTopics, topics,
          "topics of a ROS bag as NAME=TOPIC, where they are not found by themselves. NAME: motors,\n"
          "joints, encoders, left, right, left_info, right_info, tip; e.g. motors=/arm/motors,left=none")
      ->allow_extra_args(false);
}

namespace {

void refuseTopics(const std::string& file, RecordingFormat format, const std::string& topics) {
  if (format != RecordingFormat::kBag && !topics.empty())
    refuseOption(kTopics, topics, file + " is no ROS bag", "Leave --topics out");
}

}  // namespace

void addReadAs(CLI::App& command, std::string& read_as) {
  command
      .add_option(kReadAs, read_as,
                  "units of a measured table that is not in SI, as NAME=UNIT. NAME: q_m, dq_m, q, p_c, t\n"
                  "or one of their columns; UNIT: deg, mm, cm, ms, us, ns or keep; e.g. q_m=deg,q3=mm,t=ms")
      ->allow_extra_args(false);
}

recording::ReadAs readAsOf(const std::string& text) { return recording::parseReadAs(text, kReadAs); }

void refuseReadAs(const std::string& file, RecordingFormat format, const recording::ReadAs& read_as) {
  if (format == RecordingFormat::kTable || read_as.empty()) return;
  refuseOption(kReadAs, recording::formatReadAs(read_as), file + " states its units", "Leave --read-as out");
}

recording::MeasuredTable readTable(const std::string& file, RecordingFormat format,
                                   const robot::Description& robot, const recording::ReadAs& read_as,
                                   const std::string& topics) {
  refuseReadAs(file, format, read_as);
  refuseTopics(file, format, topics);
  if (format == RecordingFormat::kBag)
    return recording::tableOf(*ros1::openBag(file, robot, ros1::parseBagTopics(topics, kTopics)), file);
  if (format == RecordingFormat::kRavenMotors) return recording::readRavenMotors(file, robot);
  recording::MeasuredTable table = recording::readMeasuredTable(file);
  recording::settleUnits(table, robot, read_as);
  return table;
}

std::unique_ptr<tracking::Source> openSource(const std::string& file, RecordingFormat format,
                                             const std::string& robot_file, const recording::ReadAs& read_as,
                                             Notices notices, const std::string& topics) {
  refuseReadAs(file, format, read_as);
  refuseTopics(file, format, topics);
  if (format == RecordingFormat::kRobot)
    refuseFile(file, "is a YAML file, not a recording",
               "Give a robot file as --robot, a truth file as --truth, filter options as --options");
  if (format == RecordingFormat::kSession) {
    if (!robot_file.empty())
      refuseOption("--robot", robot_file, "the session contains its own robot",
                   "Leave --robot out; track --estimator-robot sets the robot that the filter assumes");
    return std::make_unique<recording::SessionSource>(file);
  }
  const robot::Description robot = robot::readDescriptionOrDefault(robot_file);
  if (format == RecordingFormat::kBag)
    return ros1::openBag(file, robot, ros1::parseBagTopics(topics, kTopics));
  auto source = std::make_unique<recording::TableSource>(readTable(file, format, robot, read_as), robot);
  if (notices == Notices::kSaid)
    for (const std::string& line : source->info().notices) notice(line);
  return source;
}

}  // namespace capstan::cli
