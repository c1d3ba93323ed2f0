#include "core/recording/recording_space.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace capstan::recording {

DiskSpace spaceOf(const std::filesystem::path& path, const RecorderOptions& options) {
  return options.disk_space(std::filesystem::absolute(path).parent_path());
}

std::uint64_t checkedReserve(const std::filesystem::path& path, const RecorderOptions& options) {
  const DiskSpace space = spaceOf(path, options);
  const std::uint64_t reserve = options.min_free_bytes.value_or(space.reserve);
  if (space.size > 0 && space.free < reserve)
    throw base::InputError({path.string(),
                            0,
                            {},
                            {},
                            fmt::format("cannot be recorded: {} are free there and {} are kept in reserve",
                                        sizeText(space.free), sizeText(reserve)),
                            "Free space, or choose another folder"});
  return reserve;
}

std::uint64_t logThreshold(const std::filesystem::path& path, const RecorderOptions& options) {
  constexpr std::uint64_t kShare = 32, kLeast = 1U << 20;
  const DiskSpace space = spaceOf(path, options);
  if (space.size == 0) return options.checkpoint_bytes;
  return std::min(options.checkpoint_bytes, std::max(kLeast, space.size / kShare));
}

}  // namespace capstan::recording
