#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <span>
#include <string_view>

/// Check sums of the rows of a session file. SQLite notices damaged pages, but no changed number in a row.
namespace capstan::recording {

/// CRC-32 (ISO 3309) of one row: of the table's name, and of the kind, the size and the bytes of each value.
class RowCheck {
 public:
  explicit RowCheck(std::string_view table);
  void addNull();
  void add(std::int64_t value);
  void add(double value);
  void addText(std::string_view value);
  void addBlob(std::span<const std::uint8_t> value);
  std::int64_t value() const { return static_cast<std::int64_t>(crc_); }

 private:
  void addBytes(char kind, const void* bytes, std::size_t size);

  unsigned long crc_;
};

/// Adds two SQL functions to a database:
///     row_crc(table, value…)         check sum of the row
///     row_holds(crc, table, value…)  1; SQLITE_CORRUPT, with a message that names the row by its first
///     value,
///                                    if `crc` is not row_crc(table, value…)
void addRowCheck(sqlite3* database);

}  // namespace capstan::recording
