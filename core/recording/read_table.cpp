#include "core/recording/read_table.h"

#include <fstream>

#include "core/base/error.h"
#include "core/recording/raven_motors.h"
#include "core/recording/session_file.h"
#include "core/recording/settle_units.h"
#include "core/recording/source_table.h"
#include "core/ros1/bag_source.h"
#include "core/table_files/csv.h"

namespace capstan::recording {
namespace {

std::string firstBytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be opened", "Check the path and its permissions"});
  std::string text(1024, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

}  // namespace

bool isSession(const std::filesystem::path& path) {
  return path.extension() == kSessionSuffix || firstBytes(path).starts_with("SQLite format 3");
}

bool isBag(const std::filesystem::path& path) { return ros1::isBag(firstBytes(path)); }

MeasuredTable readTable(const std::filesystem::path& path, const robot::Description& robot,
                        const ReadAs& read_as) {
  if (isBag(path)) return tableOf(*ros1::openBag(path, robot), path.string());
  if (!isRavenMotors(table_files::csvHeaderLine(firstBytes(path)))) {
    MeasuredTable table = readMeasuredTable(path);
    settleUnits(table, robot, read_as);
    return table;
  }
  if (!read_as.empty())
    throw base::InputError({path.string(), 1, "--read-as", formatReadAs(read_as),
                            "the header states the units of its columns", "Leave --read-as out"});
  return readRavenMotors(path, robot);
}

}  // namespace capstan::recording
