#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// SQLite's C interface with owners. Inside this room only.
namespace capstan::recording {

/// An error of SQLite. Callers turn it into a base::InputError (reading, creating)
/// or into a state (recording).
class SqliteError : public std::runtime_error {
 public:
  SqliteError(int code, const std::string& message) : std::runtime_error(message), code_(code) {}
  int code() const { return code_; }  ///< primary result code

 private:
  int code_;
};

/// An open database. One thread at a time.
class Database {
 public:
  enum class Mode { kRead, kReadUri, kReadWrite, kCreate };

  /// Throws SqliteError.
  Database(const std::filesystem::path& path, Mode mode);

  /// Runs statements without results. Throws SqliteError.
  void run(const std::string& sql);
  /// First column of the first row as a number; 0 without rows. Throws SqliteError.
  std::int64_t number(const std::string& sql);
  bool hasTable(std::string_view name);
  sqlite3* handle() const { return handle_.get(); }

 private:
  struct Close {
    void operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
  };
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Parameters count from 1, columns from 0. Not a number is NULL, both ways.
class Statement {
 public:
  Statement(Database& database, const std::string& sql);

  void bind(int index, double value);
  void bind(int index, std::int64_t value);
  void bind(int index, std::string_view value);               ///< copied
  void bind(int index, std::span<const std::uint8_t> value);  ///< must live until step(); empty: NULL
  void bindNull(int index);

  /// True: a row is there. Throws SqliteError.
  bool step();
  void reset();
  /// step() of a statement without rows, then reset().
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
