#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/base/error.h"
#include "core/recording/frame_codec.h"
#include "core/recording/schema.h"
#include "core/recording/session_file.h"
#include "core/recording/sqlite.h"

namespace capstan::recording {

/// Opens a session file for reading without changing it. The file may be under recording, left by a crashed
/// recorder, or on a read-only disk. Throws base::InputError with the remedy for a file that is not a
/// complete session of a known version.
Database openSession(const std::filesystem::path& path);

/// Remedy of a damaged session.
inline constexpr const char* kRecoverRemedy =
    "Restore it from a copy, or save what is readable with: capstan-cli recover FILE NEW";

/// Input error that corresponds to an SQLite error while reading `path`.
base::InputError damagedSession(const std::filesystem::path& path, const SqliteError& error);

/// Whether rows have check sums; a file of schema version 1 has none.
bool hasChecks(Database& database);
/// Rows of a table, each verified by its check sum. `rest`: WHERE, ORDER BY.
Statement rowsOf(Database& database, const Table& table, std::string_view rest = "ORDER BY seq");
SessionHeader readHeader(Database& database);
/// Vector of three columns, the first at `column`.
inline Eigen::Vector3d vectorAt(const Statement& row, int column) {
  return {row.real(column), row.real(column + 1), row.real(column + 2)};
}
inline constexpr std::size_t kMostCodecs = 64;  ///< of a session; a recording has one for each size of images
/// Decoders by row id of table `codec`.
std::map<std::int64_t, FrameDecoder> readCodecs(Database& database, const std::string& file);

}  // namespace capstan::recording
