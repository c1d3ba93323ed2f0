#include "core/recording/row_check.h"

#include <fmt/format.h>
#include <zlib.h>

#include <bit>

namespace capstan::recording {
namespace {

std::string_view textOf(sqlite3_value* value) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_value_text(value));
  return {text ? text : "", static_cast<std::size_t>(sqlite3_value_bytes(value))};
}

void add(RowCheck& check, sqlite3_value* value) {
  switch (sqlite3_value_type(value)) {
    case SQLITE_INTEGER:
      return check.add(std::int64_t{sqlite3_value_int64(value)});
    case SQLITE_FLOAT:
      return check.add(sqlite3_value_double(value));
    case SQLITE_TEXT:
      return check.addText(textOf(value));
    case SQLITE_BLOB:
      return check.addBlob({static_cast<const std::uint8_t*>(sqlite3_value_blob(value)),
                            static_cast<std::size_t>(sqlite3_value_bytes(value))});
    default:
      return check.addNull();
  }
}

std::int64_t crcOf(std::span<sqlite3_value*> arguments) {
  RowCheck check(textOf(arguments[0]));
  for (sqlite3_value* value : arguments.subspan(1)) add(check, value);
  return check.value();
}

/// Whether a call has its arguments. SQL in the file of a stranger may call the functions in any way.
bool hasArguments(sqlite3_context* context, int count, int fewest) {
  if (count >= fewest) return true;
  sqlite3_result_error(context, "too few arguments of a check sum", -1);
  return false;
}

void rowCrc(sqlite3_context* context, int count, sqlite3_value** arguments) {
  if (!hasArguments(context, count, 1)) return;
  sqlite3_result_int64(context, crcOf({arguments, static_cast<std::size_t>(count)}));
}

void rowHolds(sqlite3_context* context, int count, sqlite3_value** arguments) {
  if (!hasArguments(context, count, 3)) return;
  const std::span<sqlite3_value*> row(arguments + 1, static_cast<std::size_t>(count - 1));
  if (sqlite3_value_type(arguments[0]) == SQLITE_INTEGER && sqlite3_value_int64(arguments[0]) == crcOf(row))
    return sqlite3_result_int(context, 1);
  const std::string message =
      fmt::format("row {} of table {} is not as it was written", textOf(row[1]), textOf(row[0]));
  sqlite3_result_error(context, message.c_str(), static_cast<int>(message.size()));
  sqlite3_result_error_code(context, SQLITE_CORRUPT);
}

}  // namespace

RowCheck::RowCheck(std::string_view table) : crc_(crc32_z(0, nullptr, 0)) { addText(table); }

void RowCheck::addBytes(char kind, const void* bytes, std::size_t size) {
  const auto length = static_cast<std::uint64_t>(size);
  crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(&kind), 1);
  crc_ = crc32_z(crc_, reinterpret_cast<const Bytef*>(&length), sizeof length);
  if (size > 0) crc_ = crc32_z(crc_, static_cast<const Bytef*>(bytes), size);
}

void RowCheck::addNull() { addBytes('n', nullptr, 0); }
void RowCheck::add(std::int64_t value) { addBytes('i', &value, sizeof value); }
void RowCheck::add(double value) { addBytes('r', &value, sizeof value); }
void RowCheck::addText(std::string_view value) { addBytes('t', value.data(), value.size()); }
void RowCheck::addBlob(std::span<const std::uint8_t> value) { addBytes('b', value.data(), value.size()); }

void addRowCheck(sqlite3* database) {
  static_assert(std::endian::native == std::endian::little, "the check sum is of little-endian numbers");
  constexpr int kPure = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_DIRECTONLY;
  sqlite3_create_function(database, "row_crc", -1, kPure, nullptr, rowCrc, nullptr, nullptr);
  sqlite3_create_function(database, "row_holds", -1, kPure, nullptr, rowHolds, nullptr, nullptr);
}

}  // namespace capstan::recording
