#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/base/error.h"
#include "core/base/part_file.h"
#include "core/table_files/json_lines.h"

namespace capstan::table_files {

void appendJsonNumber(std::string& text, double value) {
  const std::size_t begin = text.size();
  fmt::format_to(std::back_inserter(text), "{}", value);
  // Readers take a number without a point as an integer, which has no negative zero.
  if (value == 0.0 && std::signbit(value)) text.replace(begin, std::string::npos, "-0.0");
}

std::string formatJsonLine(std::span<const NamedColumn> columns, std::size_t row) {
  std::string text = "{";
  for (const NamedColumn& column : columns) {
    const double value = (*column.values)[row];
    if (std::isnan(value)) continue;
    if (text.size() > 1) text += ',';
    text += '"' + column.name + "\":";
    appendJsonNumber(text, value);
  }
  return text += "}\n";
}

void writeJsonLines(const std::filesystem::path& path, std::span<const NamedColumn> columns) {
  base::PartFile part(path);
  {
    std::ofstream out(part.path(), std::ios::binary);
    const std::size_t rows = columns.empty() ? 0 : columns.front().values->size();
    for (std::size_t row = 0; row < rows && out; ++row) out << formatJsonLine(columns, row);
    out.flush();
    if (!out)
      throw base::InputError(
          {path.string(), 0, {}, {}, "cannot be written", "Check the folder, its permissions and the space"});
  }
  part.commit();
}

}  // namespace capstan::table_files
