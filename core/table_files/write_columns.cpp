#include "core/table_files/write_columns.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "core/base/yaml.h"
#include "core/table_files/json_lines.h"
#include "core/table_files/table_kind.h"

namespace capstan::table_files {

void appendCsvRow(std::span<const NamedColumn> columns, std::size_t row, std::string& text) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) text += ',';
    const double value = (*columns[i].values)[row];
    if (!std::isnan(value)) fmt::format_to(std::back_inserter(text), "{}", value);
  }
  text += '\n';
}

std::string formatCsv(std::span<const NamedColumn> columns) {
  std::string text;
  for (const NamedColumn& column : columns) text += (text.empty() ? "" : ",") + column.name;
  text += '\n';
  const std::size_t rows = columns.empty() ? 0 : columns.front().values->size();
  text.reserve(text.size() + rows * columns.size() * 12);
  for (std::size_t row = 0; row < rows; ++row) appendCsvRow(columns, row, text);
  return text;
}

void writeColumns(const std::filesystem::path& path, std::span<const NamedColumn> columns,
                  const FileAttributes& attributes, MatlabVersion matlab) {
  const TableKindFacts* kind = kindBySuffix(path);
  switch (kind ? kind->kind : TableKind::kCsv) {
    case TableKind::kCsv:
      return base::writeTextFile(path, formatCsv(columns));
    case TableKind::kJsonLines:
      return writeJsonLines(path, columns);
    case TableKind::kHdf5:
      return writeHdf5(path, columns, attributes);
    case TableKind::kMatlab:
      return writeMatlab(path, columns, matlab);
  }
}

}  // namespace capstan::table_files
