#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "app/python/native/arrays.h"
#include "core/table_files/read_columns.h"

namespace capstan::python {

/// A table that a caller gives: a file, or columns of numbers in memory. Made and destroyed with Python's
/// lock; the rest needs none.
class TableInput {
 public:
  /// `given` is a path (str), or (name, [(column, array of shape (n,)), …]) with columns of equal length.
  explicit TableInput(const pybind11::object& given);

  /// Path of the file, or name of the columns, for errors.
  const std::string& name() const { return name_; }
  bool isFile() const { return file_; }
  /// Columns of the file or of the arrays. Reading columns in memory throws base::InputError for an infinite
  /// value, with column and row.
  table_files::ColumnReader columns() const;
  /// Names of the columns in memory, separated by commas.
  std::string columnNames() const;
  /// True if both are columns in memory with the same numbers.
  bool sameArrays(const TableInput& other) const;
  /// Checksum of the numbers in memory.
  std::string checksum() const;

 private:
  struct Column {
    std::string name;
    Doubles values;
    const double* begin = nullptr;
    std::size_t size = 0;
  };

  std::string name_;
  bool file_ = true;
  std::vector<Column> columns_;
};

/// One table per element of a list.
std::vector<TableInput> tableInputs(const pybind11::list& given);
/// Names of the tables.
std::vector<std::string> namesOf(const std::vector<TableInput>& tables);
/// True if all are files. Throws base::InputError if some are and some are not.
bool areFiles(const std::vector<TableInput>& tables);
/// Throws base::InputError if two are the same arrays, because their data would count twice.
void refuseRepeatedArrays(const std::vector<TableInput>& tables);

}  // namespace capstan::python
