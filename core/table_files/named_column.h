#pragma once

#include <string>
#include <vector>

namespace capstan::table_files {

/// A column to write. All columns of a table have the same number of rows; NaN: no value.
struct NamedColumn {
  std::string name;
  std::string unit;     ///< SI
  std::string meaning;  ///< for people; may be empty
  const std::vector<double>* values = nullptr;
};

}  // namespace capstan::table_files
