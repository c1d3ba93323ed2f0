#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/recording/column_units.h"
#include "core/recording/measured_table.h"
#include "core/robot/description.h"
#include "core/tracking/source.h"

namespace capstan::cli {

enum class RecordingFormat { kSession, kTable, kRavenMotors, kRobot };

/// By suffix and first line. Throws base::InputError for a file that cannot be read or is of no known kind.
RecordingFormat detectFormat(const std::string& file);
/// The format of --format: auto (detectFormat), session, table, raven.
RecordingFormat formatOf(const std::string& name, const std::string& file);

inline constexpr const char* kReadAs = "--read-as";
/// Adds --read-as, whose text readAsOf() takes.
void addReadAs(CLI::App& command, std::string& read_as);
recording::ReadAs readAsOf(const std::string& text);
/// Throws base::InputError where --read-as is given, but `file` is no measured table: only of these units can
/// be chosen.
void refuseReadAs(const std::string& file, RecordingFormat format, const recording::ReadAs& read_as);

/// A measured table or RAVEN-II motor recording, in SI units; columns of a table are read as `read_as` says.
/// Throws recording::ImplausibleUnits.
recording::MeasuredTable readTable(const std::string& file, RecordingFormat format,
                                   const robot::Description& robot, const recording::ReadAs& read_as);
enum class Notices { kSaid, kQuiet };
/// Any recording as a source; its notices go to standard error. `robot_file` is for recordings that bring no
/// robot; with a session, which brings its own, it is an error. `read_as` as of readTable().
std::unique_ptr<tracking::Source> openSource(const std::string& file, RecordingFormat format,
                                             const std::string& robot_file, const recording::ReadAs& read_as,
                                             Notices notices = Notices::kSaid);

}  // namespace capstan::cli
