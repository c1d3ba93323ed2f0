#include "core/recording/recorder_text.h"

#include <fmt/format.h>

#include "core/recording/recorder.h"

namespace capstan::recording {

std::string adviceFor(const SqliteError& error) {
  switch (error.code()) {
    case SQLITE_FULL:
      return kFreeSpace;
    case SQLITE_MISUSE:
      return "Give both cameras one image size";
    default:
      return "Check the disk and its folder and start a new recording";
  }
}

std::string intactText(std::uint64_t lost, double lost_time) {
  if (lost == 0) return "The file is closed and intact, with every row";
  return fmt::format(
      "The file is closed and intact. The last {:.2f} s before the fault ({} rows) are not in it", lost_time,
      lost);
}

std::string besideText(const std::filesystem::path& path) {
  return fmt::format("Its newest rows are beside it in {}-wal. Keep the two files together",
                     path.filename().string());
}

std::string gapsText(std::uint64_t missing) {
  return fmt::format(
      "The recording has gaps: {} samples are missing. The disk, or the encoding of the images, was slower "
      "than "
      "the data. Record smaller or fewer images, or to a faster disk.",
      missing);
}

}  // namespace capstan::recording
