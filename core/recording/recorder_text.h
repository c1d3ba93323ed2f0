#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/recording/sqlite.h"

/// Words of the recorder's faults. For core/recording only.
namespace capstan::recording {

inline constexpr const char* kFreeSpace = "Free space, or choose another folder, and start a new recording";

/// What to do after the error.
std::string adviceFor(const SqliteError& error);
/// Of a file that a fault has closed, without its `lost` rows of the last `lost_time` seconds.
std::string intactText(std::uint64_t lost, double lost_time);
/// Of a file whose log could not be moved into it.
std::string besideText(const std::filesystem::path& path);

}  // namespace capstan::recording
