#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/table_files/column_target.h"
#include "core/table_files/table_lines.h"

namespace capstan::table_files {

/// A table that parsers of tables read: a file of any kind, or a text.
struct ColumnReader {
  TableLines lines;                                      ///< where its rows are
  std::function<void(const ColumnTarget& target)> read;  ///< gives its columns to the target
};

/// Reads the file at `path` of any kind (table_kind.h). read() throws base::InputError as parseCsv(),
/// readJsonLines(), readHdf5() and readMatlab().
ColumnReader columnsIn(const std::filesystem::path& path);
/// Parses CSV text, which must outlive the reader; `file` names it in errors.
ColumnReader columnsOfCsv(std::string_view text, const std::string& file);

/// Names of the columns at `path`, separated by commas. Reads no values. Throws as columnsIn().read(), except
/// for a file that cannot be opened, which has none.
std::string columnNames(const std::filesystem::path& path);

}  // namespace capstan::table_files
