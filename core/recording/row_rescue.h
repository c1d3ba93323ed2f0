#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/recording/schema.h"
#include "core/recording/session_writer.h"
#include "core/recording/sqlite_pages.h"

namespace capstan::recording {

/// Whether the row is one of a session, and as it was written by its check sum.
bool isAsWritten(StoredRow&& row);

/// Writes rows that SqlitePages has found into a new session: each into the table whose columns it fits and
/// by whose check sum it is as it was written.
class RowRescue {
 public:
  /// `unchecked`: rows without check sums (schema version 1) are taken, too. Begins a transaction of
  /// `writer`.
  RowRescue(SessionWriter& writer, bool unchecked);
  void take(StoredRow&& row);
  /// Commits; no row comes after it.
  void finish();

  /// Number of rows of a table that are not as they were written.
  std::int64_t damaged(const Table& table) const;
  /// Whether rows without check sums were taken.
  bool unchecked() const { return unchecked_; }
  /// Keys of the header that were taken, and those whose rows are damaged.
  const std::set<std::string>& headerKeys() const { return keys_; }
  const std::set<std::string>& damagedKeys() const { return damaged_keys_; }
  /// Entry `rows` of the header, which is not written: the new session has other numbers.
  const std::string& writtenRows() const { return written_; }

 private:
  struct Target {
    const Table* table;
    std::unique_ptr<Statement> insert;
  };
  void setAside(const StoredRow& row, const Table& table);
  void insert(const StoredRow& row, const Target& target);

  SessionWriter& writer_;
  const bool unchecked_allowed_;
  bool unchecked_ = false;
  std::vector<Target> inserts_;
  std::map<const Table*, std::int64_t> damaged_;
  std::set<std::string> keys_, damaged_keys_;
  std::string written_;
  std::uint64_t rows_ = 0;
};

}  // namespace capstan::recording
