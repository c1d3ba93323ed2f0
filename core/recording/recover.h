#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/recording/sqlite_pages.h"

namespace capstan::recording {

struct RecoverOptions {
  std::string robot;  ///< robot file (YAML text) for a session whose own is lost; empty: none
};

/// Options with the text of a robot file; empty: none. Throws base::InputError for a file that is none.
RecoverOptions recoverOptions(const std::filesystem::path& robot);

/// Rows of one table of samples.
struct RecoveredRows {
  std::string table;
  std::int64_t saved = 0;
  std::int64_t damaged = 0;  ///< found, but not as they were written; left out
  /// Number that the recording had when it ended; nothing if it did not end, or if that is lost.
  std::optional<std::int64_t> written;
};

/// Successive rows that are lost, in the order of arrival over all tables.
struct LostRows {
  std::int64_t count = 0;
  double after = 0.0, before = 0.0;  ///< times of the saved samples around them [s]; before is NaN at the end
};

/// Result of recoverSession().
struct Recovery {
  /// Why the file is not whole; empty: every row is there and as it was written.
  std::string fault;
  /// False: there are rows without check sums (schema version 1), in which no change is noticed.
  bool checked = true;
  std::vector<RecoveredRows> tables;
  std::vector<LostRows> lost;            ///< the first kMostLost of them
  std::int64_t lost_rows = 0;            ///< number of all lost rows that are known
  std::vector<std::string> lost_header;  ///< entries of the header that are lost
  PageCounts pages;

  std::int64_t saved() const;
  bool whole() const { return fault.empty(); }
  /// True if nothing is lost: the file is whole, or every row and header entry of a damaged one was saved.
  bool complete() const;
};
inline constexpr std::size_t kMostLost = 100;

/// Writes what can be read of the session file `from` (and of the log beside it) into the new session file
/// `to`. It reads every page of the file, also of files that SQLite does not open, and verifies every row by
/// its check sum. `from` is not changed. `to` is written only if a sample was saved, and not if `progress` is
/// cancelled. Throws base::InputError if `from` cannot be read, has no robot and `options` has none either,
/// or if `to` cannot be written.
Recovery recoverSession(const std::filesystem::path& from, const std::filesystem::path& to,
                        const RecoverOptions& options = {}, base::Progress* progress = nullptr);

/// Whether the error is that of a damaged session, of which recoverSession() may save something.
bool isRecoverable(const base::InputError& error);
/// Whether recoverSession() refused because the robot is lost: with RecoverOptions::robot it can go on.
bool lacksRobot(const base::InputError& error);

/// Why the session is not whole: reads and verifies every row. Empty: it is whole.
std::string faultOf(const std::filesystem::path& session, base::Progress* progress = nullptr);

}  // namespace capstan::recording
