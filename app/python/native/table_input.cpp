#include "app/python/native/table_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/checksum.h"
#include "core/base/error.h"

namespace capstan::python {

namespace py = pybind11;

TableInput::TableInput(const py::object& given) {
  if (py::isinstance<py::str>(given)) {
    name_ = given.cast<std::string>();
    return;
  }
  file_ = false;
  const auto [name, columns] = given.cast<std::pair<std::string, py::list>>();
  name_ = name;
  for (const py::handle item : columns) {
    auto [column, values] = item.cast<std::pair<std::string, Doubles>>();
    const double* begin = values.data();
    const auto size = static_cast<std::size_t>(values.size());
    columns_.push_back({std::move(column), std::move(values), begin, size});
  }
  for (const Column& column : columns_)
    if (column.size != columns_.front().size)
      throw base::InputError({name_, 0, column.name, fmt::format("{} rows", column.size),
                              fmt::format("{} has {}", columns_.front().name, columns_.front().size),
                              "Give all columns the same number of rows"});
  if (columns_.empty() || columns_.front().size == 0)
    throw base::InputError({name_, 0, {}, {}, "has no rows", "Give columns of numbers"});
}

table_files::ColumnReader TableInput::columns() const {
  if (file_) return table_files::columnsIn(name_);
  return {{.first = 0}, [this](const table_files::ColumnTarget& target) {
            for (std::size_t i = 0; i < columns_.size(); ++i) {
              const Column& column = columns_[i];
              std::vector<double>* values = target(column.name, i);
              if (!values) continue;
              values->assign(column.begin, column.begin + column.size);
              const auto found =
                  std::find_if(values->begin(), values->end(), [](double x) { return std::isinf(x); });
              if (found != values->end())
                throw base::InputError(table_files::TableLines{.first = 0}.at(
                    name_, static_cast<std::size_t>(found - values->begin()), column.name,
                    fmt::format("{}", *found), "is not a finite number",
                    "Give a finite number, or NaN where there is no value"));
            }
          }};
}

std::string TableInput::columnNames() const {
  std::string names;
  for (const Column& column : columns_) names += (names.empty() ? "" : ",") + column.name;
  return names;
}

bool TableInput::sameArrays(const TableInput& other) const {
  if (file_ || other.file_) return false;
  return std::equal(columns_.begin(), columns_.end(), other.columns_.begin(), other.columns_.end(),
                    [](const Column& a, const Column& b) {
                      return a.name == b.name && a.size == b.size &&
                             std::memcmp(a.begin, b.begin, a.size * sizeof(double)) == 0;
                    });
}

std::string TableInput::checksum() const {
  std::string bytes;
  for (const Column& column : columns_) {
    bytes += column.name + '\n';
    bytes.append(reinterpret_cast<const char*>(column.begin), column.size * sizeof(double));
  }
  return base::checksumOf(bytes);
}

std::vector<TableInput> tableInputs(const py::list& given) {
  std::vector<TableInput> tables;
  for (const py::handle one : given) tables.emplace_back(py::reinterpret_borrow<py::object>(one));
  return tables;
}

std::vector<std::string> namesOf(const std::vector<TableInput>& tables) {
  std::vector<std::string> names;
  for (const TableInput& table : tables) names.push_back(table.name());
  return names;
}

bool areFiles(const std::vector<TableInput>& tables) {
  const auto files = std::ranges::count_if(tables, &TableInput::isFile);
  if (files == 0 || files == static_cast<std::ptrdiff_t>(tables.size())) return files > 0;
  throw base::InputError({tables.front().name(),
                          0,
                          {},
                          {},
                          "files and arrays are given together",
                          "Give either files or arrays"});
}

void refuseRepeatedArrays(const std::vector<TableInput>& tables) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tables[j].sameArrays(tables[i]))
        throw base::InputError({tables[i].name(),
                                0,
                                {},
                                {},
                                "is the same recording as " + tables[j].name() + ": it would count twice",
                                "Give each recording once"});
}

}  // namespace capstan::python
