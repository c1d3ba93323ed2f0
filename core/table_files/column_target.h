#pragma once

#include <functional>
#include <string_view>
#include <vector>

namespace capstan::table_files {

/// Returns the vector for the values of the column `name`; null: the column is ignored and its values are not
/// parsed. `index` counts columns from 0. A reader calls it once for each column name that it meets; a CSV
/// reader also calls it for a name that is given twice.
using ColumnTarget = std::function<std::vector<double>*(std::string_view name, std::size_t index)>;

}  // namespace capstan::table_files
