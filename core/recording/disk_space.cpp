#include "core/recording/disk_space.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/base/part_file.h"

namespace capstan::recording {
namespace {

constexpr std::uint64_t kMostReserve = 256U << 20;
constexpr std::uint64_t kReserveShare = 10;  ///< the reserve is at most 1 / kReserveShare of the disk
constexpr double kPeriod = 2.0;              ///< [s]

std::filesystem::path nearestFolder(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::path place = std::filesystem::absolute(folder, fault).lexically_normal();
  while (!std::filesystem::exists(place, fault) && place.has_relative_path()) place = place.parent_path();
  return place;
}

}  // namespace

DiskSpace diskSpaceAt(const std::filesystem::path& folder) {
  std::error_code fault;
  const auto space = std::filesystem::space(nearestFolder(folder), fault);
  if (fault) return {};
  return {space.available, std::min(kMostReserve, space.capacity / kReserveShare), space.capacity};
}

void checkRecordingFolder(const std::filesystem::path& folder) {
  const auto refuse = [&](const std::string& reason) {
    throw base::InputError({folder.string(), 0, {}, {}, reason, "Choose another folder for recordings"});
  };
  const std::filesystem::path place = nearestFolder(folder);
  std::error_code fault;
  if (!std::filesystem::is_directory(place, fault)) refuse("is no folder");
  try {
    base::checkWritable(place / "recording.capstan");
  } catch (const base::InputError& error) {
    refuse(error.fault().reason);
  }
  const DiskSpace space = diskSpaceAt(place);
  if (space.size > 0 && space.free < space.reserve)
    refuse("is on a disk of which only the reserve of " + sizeText(space.reserve) + " is free");
}

std::string sizeText(std::uint64_t bytes) {
  const double megabytes = 1e-6 * static_cast<double>(bytes);
  if (megabytes < 1e3) return fmt::format("{:.{}f} MB", megabytes, megabytes < 10.0 ? 1 : 0);
  return fmt::format("{:.{}f} GB", 1e-3 * megabytes, megabytes < 1e4 ? 1 : 0);
}

void GrowthRate::add(Clock::time_point now, std::uint64_t bytes) {
  const double elapsed = std::chrono::duration<double>(now - since_).count();
  if (since_ != Clock::time_point{} && elapsed < kPeriod) return;
  if (since_ != Clock::time_point{}) rate_ = static_cast<double>(bytes - std::min(bytes, bytes_)) / elapsed;
  since_ = now;
  bytes_ = bytes;
}

double GrowthRate::timeToGrow(std::uint64_t bytes) const {
  return rate_ > 0.0 ? static_cast<double>(bytes) / rate_ : 0.0;
}

}  // namespace capstan::recording
