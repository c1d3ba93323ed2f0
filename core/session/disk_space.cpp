#include "core/session/disk_space.h"

#include <fmt/format.h>

#include <algorithm>

namespace capstan::session {
namespace {

constexpr std::uint64_t kMostReserve = 256U << 20;
constexpr std::uint64_t kReserveShare = 10;  ///< of a small disk: one part in so many
constexpr double kPeriod = 2.0;              ///< [s]

}  // namespace

DiskSpace diskSpaceAt(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::path place = std::filesystem::absolute(folder, fault).lexically_normal();
  while (!std::filesystem::exists(place, fault) && place.has_relative_path()) place = place.parent_path();
  const auto space = std::filesystem::space(place, fault);
  if (fault) return {};
  return {space.available, std::min(kMostReserve, space.capacity / kReserveShare), space.capacity};
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

}  // namespace capstan::session
