#pragma once

#include <string>
#include <string_view>

#include "core/table_files/column_target.h"

namespace capstan::table_files {

/// Parses a CSV table of numbers with one header line: commas, LF or CRLF, optional byte order mark; an empty
/// cell is NaN. Row r (from 0) is line r + 2. Throws base::InputError naming file, line, column, value and
/// remedy for a missing header, a cell that is not a finite number, a wrong number of cells, or no rows.
void parseCsv(std::string_view text, const std::string& file, const ColumnTarget& target);

/// First line of `text`, without its line end and byte order mark.
std::string_view csvHeaderLine(std::string_view text);

}  // namespace capstan::table_files
