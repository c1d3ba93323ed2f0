#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/recording/frame_codec.h"
#include "core/recording/session_file.h"
#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Opens a session file to read, never changing it: also one that is being recorded, one whose recorder died,
/// and one on a read-only disk. Throws base::InputError with the remedy for anything that is not a whole
/// session of a version that this program knows.
Database openSession(const std::filesystem::path& path);

/// The error that an SQLite answer to reading `path` means.
base::InputError damagedSession(const std::filesystem::path& path, const SqliteError& error);

SessionHeader readHeader(Database& database);
/// Three columns from `column` on.
inline Eigen::Vector3d vectorAt(const Statement& row, int column) {
  return {row.real(column), row.real(column + 1), row.real(column + 2)};
}
/// Row id → decoder.
std::map<std::int64_t, FrameDecoder> readCodecs(Database& database, const std::string& file);

}  // namespace capstan::recording
