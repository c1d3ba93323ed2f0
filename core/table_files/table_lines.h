#pragma once

#include <fmt/format.h>

#include <string>

#include "core/base/error.h"

namespace capstan::table_files {

/// Lines of a table in its file, for errors. A file without lines (HDF5, MATLAB) has `first` 0.
struct TableLines {
  int first = 2;  ///< line of the first row; the header is on the line before, if there is one

  /// Line of the column names, or of the first row that has them; 0: a file without lines.
  int header() const { return first == 2 ? 1 : first; }
  /// Number of the row at `index`, which counts from 0: its line, or its number from 1.
  std::size_t number(std::size_t index) const {
    return index + static_cast<std::size_t>(first == 0 ? 1 : first);
  }
  /// The fault at the row `index` of column `key`.
  base::InputFault at(const std::string& file, std::size_t index, const std::string& key,
                      const std::string& value, const std::string& reason, const std::string& remedy) const {
    if (first == 0) return {file, 0, fmt::format("{}, row {}", key, index + 1), value, reason, remedy};
    return {file, static_cast<int>(number(index)), key, value, reason, remedy};
  }
};

}  // namespace capstan::table_files
