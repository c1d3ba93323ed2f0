#pragma once

#include <memory>
#include <string>

#include "core/robot/description.h"
#include "core/session/measured_table.h"
#include "core/session/source.h"

namespace capstan::cli {

enum class RecordingFormat { kSession, kTable, kRavenMotors, kRobot };

/// By suffix and first line. Throws base::InputError for a file that cannot be read or is of no known kind.
RecordingFormat detectFormat(const std::string& file);
/// The format of --format: auto (detectFormat), session, table, raven.
RecordingFormat formatOf(const std::string& name, const std::string& file);

/// The robot file, or the left RAVEN-II where `file` is empty.
robot::Description readRobot(const std::string& file);

/// A measured table or RAVEN-II motor recording.
session::MeasuredTable readTable(const std::string& file, RecordingFormat format,
                                 const robot::Description& robot);
enum class Notices { kSaid, kQuiet };
/// Any recording as a source; its notices go to standard error. `robot_file` is for recordings that bring no
/// robot; with a session, which brings its own, it is an error.
std::unique_ptr<session::Source> openSource(const std::string& file, RecordingFormat format,
                                            const std::string& robot_file, Notices notices = Notices::kSaid);

}  // namespace capstan::cli
