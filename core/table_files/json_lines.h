#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

#include "core/table_files/column_target.h"
#include "core/table_files/named_column.h"

/// JSON Lines (jsonlines.org): one JSON object a line, `{"t": 12.001, "q_m1": 81.26}`. A key is a column. A
/// key that a row does not have, or whose value is null, has no value there: NaN.
namespace capstan::table_files {

/// Longest line that is read, in bytes; no more of a file is in memory than this beside its columns.
inline constexpr std::size_t kLongestJsonLine = 1U << 16;

/// Reads the file at `path`; row r (from 0) is line r + 1. A column that begins in a later row is NaN before.
/// Throws base::InputError naming file, line, key, value and remedy for a line that is no JSON object or is
/// too long, a key given twice, a value that is not a finite number, and a file without rows.
void readJsonLines(const std::filesystem::path& path, const ColumnTarget& target);
/// The same from a stream; `file` names it in errors.
void readJsonLines(std::istream& in, const std::string& file, const ColumnTarget& target);
/// The same of the first line alone.
void readFirstJsonLine(std::istream& in, const std::string& file, const ColumnTarget& target);

/// The line of one row, with its line end: every column that has a value there, in the shortest decimals that
/// read back to the last bit.
std::string formatJsonLine(std::span<const NamedColumn> columns, std::size_t row);
/// Appends a finite number as JSON, in such decimals.
void appendJsonNumber(std::string& text, double value);
/// Writes a table, one row after the other. Throws base::InputError when it cannot be written.
void writeJsonLines(const std::filesystem::path& path, std::span<const NamedColumn> columns);

}  // namespace capstan::table_files
