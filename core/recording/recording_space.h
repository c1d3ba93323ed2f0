#pragma once

#include <cstdint>
#include <filesystem>

#include "core/recording/disk_space.h"
#include "core/recording/recorder.h"

namespace capstan::recording {

/// Space on the disk of a recording at `path`, from `options.disk_space`.
DiskSpace spaceOf(const std::filesystem::path& path, const RecorderOptions& options);

/// Reserve that a recording at `path` keeps free [bytes]. Throws base::InputError if only the reserve is
/// free.
std::uint64_t checkedReserve(const std::filesystem::path& path, const RecorderOptions& options);

/// Log size that starts a checkpoint [bytes]; it is smaller on a small disk, where the file needs the space.
std::uint64_t logThreshold(const std::filesystem::path& path, const RecorderOptions& options);

}  // namespace capstan::recording
