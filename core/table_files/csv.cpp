#include "core/table_files/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/base/error.h"
#include "core/base/nan.h"

namespace capstan::table_files {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view withoutMark(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  return text;
}

/// Returns the text up to `separator` and removes it from the front of `rest`.
std::string_view take(std::string_view& rest, char separator) {
  const void* found = rest.empty() ? nullptr : std::memchr(rest.data(), separator, rest.size());
  const std::size_t length =
      found ? static_cast<std::size_t>(static_cast<const char*>(found) - rest.data()) : rest.size();
  const std::string_view part = rest.substr(0, length);
  rest.remove_prefix(std::min(rest.size(), length + 1));
  return part;
}

struct Header {
  std::vector<std::string> names;
  std::vector<std::vector<double>*> targets;
};

Header parseHeader(std::string_view line, const std::string& file, const ColumnTarget& target) {
  if (trimmed(line).empty())
    throw base::InputError(
        {file,
         1,
         {},
         {},
         "has no header line",
         "Begin the table with column names, of joints t,q_m1,… or of tip poses traj,t_cam_s,cam_x,…"});
  if (line.find(',') == std::string_view::npos &&
      trimmed(line).find_first_of("; \t") != std::string_view::npos)
    throw base::InputError({file,
                            1,
                            {},
                            std::string(line.substr(0, 40)),
                            "is not separated by commas",
                            "Save the table with commas between cells and points in numbers"});
  Header header;
  for (bool more = true; more;) {
    more = line.find(',') != std::string_view::npos;
    header.names.emplace_back(trimmed(take(line, ',')));
  }
  for (std::size_t i = 0; i < header.names.size(); ++i) header.targets.push_back(target(header.names[i], i));
  return header;
}

bool parseNumber(std::string_view cell, double& value) {
  cell = trimmed(cell);
  if (cell.empty()) {
    value = base::kNaN;
    return true;
  }
  if (cell.front() == '+') cell.remove_prefix(1);
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return fault == std::errc() && end == cell.data() + cell.size() && std::isfinite(value);
}

void parseRow(std::string_view row, int line, const std::string& file, const Header& header) {
  const std::size_t count = header.names.size();
  const auto cells = static_cast<std::size_t>(std::count(row.begin(), row.end(), ',')) + 1;
  if (cells != count)
    throw base::InputError({file,
                            line,
                            {},
                            {},
                            fmt::format("has {} cells where the header has {}", cells, count),
                            "Give every row one cell for each column; an empty cell stands for no value"});
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view cell = take(row, ',');
    if (!header.targets[i]) continue;
    double value = 0.0;
    if (!parseNumber(cell, value))
      throw base::InputError({file, line, header.names[i], std::string(trimmed(cell)),
                              "is not a finite number",
                              "Write a decimal number, or leave the cell empty where there is no value"});
    header.targets[i]->push_back(value);
  }
}

}  // namespace

void parseCsv(std::string_view text, const std::string& file, const ColumnTarget& target) {
  text = withoutMark(text);
  std::string_view rest = text;
  const Header header = parseHeader(take(rest, '\n'), file, target);
  while (!rest.empty() && (rest.back() == '\n' || rest.back() == '\r')) rest.remove_suffix(1);
  if (rest.empty())
    throw base::InputError({file, 2, {}, {}, "has no rows", "Add at least one row of values"});
  // A row has a comma between any two cells: empty lines reserve nothing.
  const auto lines = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\n')) + 1;
  for (std::vector<double>* column : header.targets)
    if (column) column->reserve(std::min(lines, rest.size() / header.names.size() + 1));
  for (int line = 2; !rest.empty(); ++line) parseRow(take(rest, '\n'), line, file, header);
}

std::string_view csvHeaderLine(std::string_view text) {
  std::string_view rest = withoutMark(text);
  return trimmed(take(rest, '\n'));
}

}  // namespace capstan::table_files
