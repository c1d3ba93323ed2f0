#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::cli {

enum class RecordingFormat { kSession, kTable, kRavenMotors, kRobot, kBag };

/// Format of `file`, by its suffix and first line. Throws base::InputError for a file that cannot be read.
RecordingFormat detectFormat(const std::string& file);
/// Format that --format names: auto (as detectFormat()), session, table, raven. Throws as detectFormat().
RecordingFormat formatOf(const std::string& name, const std::string& file);

inline constexpr const char* kTopics = "--topics";
/// Declares --topics on `command`: topics of a ROS bag.
void addTopics(CLI::App& command, std::string& topics);

inline constexpr const char* kReadAs = "--read-as";
/// Declares --read-as on `command`; readAsOf() parses its text.
void addReadAs(CLI::App& command, std::string& read_as);
recording::ReadAs readAsOf(const std::string& text);
/// Throws base::InputError where --read-as is given, but `file` is no measured table: other formats state
/// their units.
void refuseReadAs(const std::string& file, RecordingFormat format, const recording::ReadAs& read_as);

/// Reads a measured table, with the units in `read_as`, a RAVEN-II motor log, or a ROS bag. The result is in
/// SI units. Throws recording::ImplausibleUnits.
recording::MeasuredTable readTable(const std::string& file, RecordingFormat format,
                                   const robot::Description& robot, const recording::ReadAs& read_as,
                                   const std::string& topics = {});
enum class Notices { kSaid, kQuiet };
/// Opens any recording as a source; its notices go to standard error. `robot_file` is for recordings that
/// contain no robot; with a session, which contains one, it is an error. `read_as` as in readTable();
/// `topics` of a ROS bag, as
/// --topics states them.
std::unique_ptr<tracking::Source> openSource(const std::string& file, RecordingFormat format,
                                             const std::string& robot_file, const recording::ReadAs& read_as,
                                             Notices notices = Notices::kSaid,
                                             const std::string& topics = {});

}  // namespace capstan::cli
