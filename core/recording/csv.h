#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::recording {

/// Where the values of the column `name` go; null: the column is ignored, its cells are not looked at.
/// `index` counts columns from 0.
using CsvTarget = std::function<std::vector<double>*(std::string_view name, std::size_t index)>;

/// Parses a CSV table of numbers with one header line: commas, LF or CRLF, optional byte order mark; an empty
/// cell is NaN. Row r (from 0) stands on line r + 2. Throws base::InputError naming file, line,
/// column, value and remedy: no header, a cell that is no finite number, a wrong number of cells, no rows.
void parseCsv(std::string_view text, const std::string& file, const CsvTarget& target);

/// First line of `text`, without its line end and byte order mark.
std::string_view csvHeaderLine(std::string_view text);

}  // namespace capstan::recording
