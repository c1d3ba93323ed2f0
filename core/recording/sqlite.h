#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// SQLite's C interface with owning classes. For core/recording only.
namespace capstan::recording {

/// Error of SQLite. Callers convert it to a base::InputError (reading, creating) or to a state (recording).
class SqliteError : public std::runtime_error {
 public:
  SqliteError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  int code() const { return code_; }  ///< primary result code

 private:
  int code_;
};

/// An open database, for one thread at a time.
class Database {
 public:
  enum class Mode { kRead, kReadUri, kReadWrite, kCreate };

  /// Throws SqliteError.
  Database(const std::filesystem::path& path, Mode mode);

  /// Executes SQL statements without results. Throws SqliteError.
  void run(const std::string& sql);
  /// First column of the first row as a number; 0 without rows. Throws SqliteError.
  std::int64_t number(const std::string& sql);
  /// Whether there is a table of this name with rows of its own: neither a view nor a virtual table.
  bool hasTable(std::string_view name);
  /// Whether the table has columns whose values are computed by the file's own SQL.
  bool hasComputedColumns(std::string_view table);
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters count from 1, columns from 0. NaN is written as NULL, and NULL is read as
/// NaN.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  void bind(int index, double value);
  void bind(int index, std::int64_t value);
  void bind(int index, std::string_view value);               ///< copied
  void bind(int index, std::span<const std::uint8_t> value);  ///< must stay valid until step(); empty: NULL
  void bindNull(int index);

  /// Steps to the next row; true: there is one. Throws SqliteError.
  bool step();
  void reset();
  /// Executes a statement without rows and resets it.
  void execute();

  double real(int column) const;
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::span<const std::uint8_t> blob(int column) const;  ///< valid until the next step() or reset()
  bool isNull(int column) const;
  bool isReal(int column) const { return sqlite3_column_type(handle_.get(), column) == SQLITE_FLOAT; }
  int columns() const { return sqlite3_column_count(handle_.get()); }
  std::string columnName(int column) const { return sqlite3_column_name(handle_.get(), column); }

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
  };
  void check(int code) const;

  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace capstan::recording
