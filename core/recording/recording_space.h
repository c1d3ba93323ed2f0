#pragma once

#include <cstdint>
#include <filesystem>

#include "core/recording/disk_space.h"
#include "core/recording/recorder.h"

namespace capstan::recording {

/// Space of the disk that a recording at `path` goes to, by `options.disk_space`.
DiskSpace spaceOf(const std::filesystem::path& path, const RecorderOptions& options);

/// The reserve that a recording at `path` keeps free [bytes]. Throws base::InputError where only that is
/// left.
std::uint64_t checkedReserve(const std::filesystem::path& path, const RecorderOptions& options);

/// Log that starts a checkpoint [bytes]: on a small disk it must not take what the file needs.
std::uint64_t logThreshold(const std::filesystem::path& path, const RecorderOptions& options);

}  // namespace capstan::recording
