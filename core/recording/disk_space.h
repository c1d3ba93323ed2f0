#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

namespace capstan::recording {

/// Room on the disk that a recording goes to.
struct DiskSpace {
  std::uint64_t free = 0;     ///< for this user [bytes]
  std::uint64_t reserve = 0;  ///< a recording stops before less than this is free [bytes]
  std::uint64_t size = 0;     ///< of the whole disk [bytes]; 0: unknown
};

/// Of the disk that holds `folder`, or the nearest folder above it that exists. All zero where the system
/// gives no answer. The reserve is 256 MiB, a tenth of the disk where that is less.
DiskSpace diskSpaceAt(const std::filesystem::path& folder);

/// Throws base::InputError where recordings cannot go to `folder`, or, as long as it is not there, to the
/// nearest folder above it: nothing can be written there, or only the reserve is left.
void checkRecordingFolder(const std::filesystem::path& folder);

/// "12.3 GB", "1.6 MB"
std::string sizeText(std::uint64_t bytes);

/// How fast a file grows: over the last seconds, measured again every two.
class GrowthRate {
 public:
  using Clock = std::chrono::steady_clock;

  void add(Clock::time_point now, std::uint64_t bytes);
  double bytesPerSecond() const { return rate_; }  ///< 0: not known yet

 private:
  Clock::time_point since_{};
  std::uint64_t bytes_ = 0;
  double rate_ = 0.0;
};

}  // namespace capstan::recording
