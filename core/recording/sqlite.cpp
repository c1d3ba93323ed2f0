#include "core/recording/sqlite.h"

#include <cmath>
#include <limits>

#include "core/recording/row_check.h"

namespace capstan::recording {
namespace {

[[noreturn]] void fail(sqlite3* handle, int code) {
  const char* message = handle ? sqlite3_errmsg(handle) : sqlite3_errstr(code);
  throw SqliteError(code & 0xff, message ? message : "unknown SQLite error");
}

/// The file may come from a stranger (SQLite, Defense Against The Dark Arts): its schema calls no functions,
/// cells are checked, and a value has limits. A frame of two million pixels has 6 MB.
void distrust(sqlite3* handle) {
  constexpr int kLongestValue = 1 << 28;  // [bytes]
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kLongestValue);
  sqlite3_exec(handle, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
}

}  // namespace

Database::Database(const std::filesystem::path& path, Mode mode) {
  int flags = SQLITE_OPEN_NOMUTEX;
  if (mode == Mode::kRead) flags |= SQLITE_OPEN_READONLY;
  if (mode == Mode::kReadUri) flags |= SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
  if (mode == Mode::kReadWrite) flags |= SQLITE_OPEN_READWRITE;
  if (mode == Mode::kCreate) flags |= SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail(handle, code);
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, 2000);
  distrust(handle);
  addRowCheck(handle);
}

void Database::run(const std::string& sql) {
  const int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(handle_.get(), code);
}

std::int64_t Database::number(const std::string& sql) {
  Statement statement(*this, sql);
  return statement.step() ? statement.integer(0) : 0;
}

bool Database::hasTable(std::string_view name) {
  Statement statement(*this,
                      "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ? "
                      "AND rootpage > 0");
  statement.bind(1, name);
  return statement.step() && statement.integer(0) == 1;
}

bool Database::hasComputedColumns(std::string_view table) {
  Statement statement(*this, "SELECT count(*) FROM pragma_table_xinfo(?) WHERE hidden <> 0");
  statement.bind(1, table);
  return statement.step() && statement.integer(0) > 0;
}

Statement::Statement(Database& database, const std::string& sql) {
  sqlite3_stmt* handle = nullptr;
  const int code =
      sqlite3_prepare_v2(database.handle(), sql.c_str(), static_cast<int>(sql.size()), &handle, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail(database.handle(), code);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) fail(sqlite3_db_handle(handle_.get()), code);
}

void Statement::bind(int index, double value) {
  check(std::isnan(value) ? sqlite3_bind_null(handle_.get(), index)
                          : sqlite3_bind_double(handle_.get(), index, value));
}
void Statement::bind(int index, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), index, value));
}
void Statement::bind(int index, std::string_view value) {
  check(sqlite3_bind_text(handle_.get(), index, value.data(), static_cast<int>(value.size()),
                          SQLITE_TRANSIENT));
}
void Statement::bind(int index, std::span<const std::uint8_t> value) {
  if (value.empty()) return bindNull(index);
  check(sqlite3_bind_blob64(handle_.get(), index, value.data(), value.size(), SQLITE_STATIC));
}
void Statement::bindNull(int index) { check(sqlite3_bind_null(handle_.get(), index)); }

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  sqlite3* database = sqlite3_db_handle(handle_.get());
  const SqliteError error(code & 0xff, sqlite3_errmsg(database));
  sqlite3_reset(handle_.get());
  throw SqliteError(error);
}

void Statement::reset() { sqlite3_reset(handle_.get()); }

void Statement::execute() {
  step();
  reset();
}

double Statement::real(int column) const {
  return isNull(column) ? std::numeric_limits<double>::quiet_NaN()
                        : sqlite3_column_double(handle_.get(), column);
}
std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }
std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column)))
              : std::string();
}
std::span<const std::uint8_t> Statement::blob(int column) const {
  const auto* data = static_cast<const std::uint8_t*>(sqlite3_column_blob(handle_.get(), column));
  return {data, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}
bool Statement::isNull(int column) const { return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL; }

}  // namespace capstan::recording
