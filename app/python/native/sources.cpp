#include "app/python/native/sources.h"

#include "app/cli/recordings.h"
#include "core/recording/settle_units.h"
#include "core/recording/table_source.h"

namespace capstan::python {

recording::ReadAs readAsOf(const std::string& text) { return recording::parseReadAs(text, "read_as"); }

recording::MeasuredTable readTable(const TableInput& table, const robot::Description& robot,
                                   const recording::ReadAs& read_as) {
  if (table.isFile()) return cli::readTable(table.name(), cli::detectFormat(table.name()), robot, read_as);
  recording::MeasuredTable numbers = recording::readMeasuredTable(table.columns(), table.name());
  recording::settleUnits(numbers, robot, read_as);
  return numbers;
}

std::unique_ptr<tracking::Source> openSource(const TableInput& recording, const std::string& robot,
                                             const recording::ReadAs& read_as, const std::string& topics) {
  if (recording.isFile())
    return cli::openSource(recording.name(), cli::detectFormat(recording.name()), robot, read_as,
                           cli::Notices::kQuiet, topics);
  const robot::Description description = robot::readDescriptionOrDefault(robot);
  return std::make_unique<recording::TableSource>(readTable(recording, description, read_as), description);
}

bool isSession(const TableInput& recording) {
  return recording.isFile() && cli::detectFormat(recording.name()) == cli::RecordingFormat::kSession;
}

}  // namespace capstan::python
