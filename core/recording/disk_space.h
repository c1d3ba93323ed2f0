#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace capstan::recording {

/// Space on the disk of a recording.
struct DiskSpace {
  std::uint64_t free = 0;     ///< free space for this user [bytes]
  std::uint64_t reserve = 0;  ///< free space that a recording must leave [bytes]
  std::uint64_t size = 0;     ///< size of the whole disk [bytes]; 0: unknown
};

/// Space on the disk that holds `folder`, or the nearest folder above it that exists. All zero if the system
/// gives no answer. The reserve is 256 MiB or a tenth of the disk, whichever is less.
DiskSpace diskSpaceAt(const std::filesystem::path& folder);

/// Throws base::InputError if recordings cannot be stored in `folder` (or, if it does not exist, in the
/// nearest existing folder above it): it is not writable, or only the reserve is free.
void checkRecordingFolder(const std::filesystem::path& folder);

/// Size for people, e.g. "12.3 GB", "1.6 MB".
std::string sizeText(std::uint64_t bytes);

/// Growth rate of a file: mean over the last 2 s or a little more.
class GrowthRate {
 public:
  using Clock = std::chrono::steady_clock;

  void add(Clock::time_point now, std::uint64_t bytes);
  /// Time in which the file grows by `bytes` at this rate [s]; 0: the rate is not known yet, or is zero.
  double timeToGrow(std::uint64_t bytes) const;

 private:
  Clock::time_point since_{};
  std::uint64_t bytes_ = 0;
  double rate_ = 0.0;  ///< [bytes/s]
};

}  // namespace capstan::recording
