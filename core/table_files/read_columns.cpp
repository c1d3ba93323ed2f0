#include "core/table_files/read_columns.h"

#include <fstream>

#include "core/base/yaml.h"
#include "core/table_files/csv.h"
#include "core/table_files/hdf5_read.h"
#include "core/table_files/json_lines.h"
#include "core/table_files/matlab.h"
#include "core/table_files/table_kind.h"

namespace capstan::table_files {

ColumnReader columnsIn(const std::filesystem::path& path) {
  switch (kindOf(path)) {
    case TableKind::kJsonLines:
      return {{.first = 1}, [path](const ColumnTarget& target) { readJsonLines(path, target); }};
    case TableKind::kHdf5:
      return {{.first = 0}, [path](const ColumnTarget& target) { readHdf5(path, target); }};
    case TableKind::kMatlab:
      return {{.first = 0}, [path](const ColumnTarget& target) { readMatlab(path, target); }};
    case TableKind::kCsv:
      break;
  }
  return {{.first = 2},
          [path](const ColumnTarget& target) { parseCsv(base::readTextFile(path), path.string(), target); }};
}

ColumnReader columnsOfCsv(std::string_view text, const std::string& file) {
  return {{.first = 2}, [text, file](const ColumnTarget& target) { parseCsv(text, file, target); }};
}

std::string columnNames(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path)) return {};
  const TableKind kind = kindOf(path);
  std::string names;
  if (kind == TableKind::kCsv) {
    std::getline(in, names);
    return std::string(csvHeaderLine(names));
  }
  const ColumnTarget collect = [&](std::string_view name, std::size_t) -> std::vector<double>* {
    names += (names.empty() ? "" : ",") + std::string(name);
    return nullptr;
  };
  if (kind == TableKind::kJsonLines)
    readFirstJsonLine(in, path.string(), collect);
  else
    columnsIn(path).read(collect);
  return names;
}

}  // namespace capstan::table_files
