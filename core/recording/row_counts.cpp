#include "core/recording/row_counts.h"

#include <fmt/format.h>

#include <sstream>

namespace capstan::recording {
namespace {

std::string_view nameOf(std::size_t which) { return table(static_cast<SampleTable>(which)).name; }

}  // namespace

RowCounts rowCounts(Database& database) {
  RowCounts counts{};
  for (std::size_t k = 0; k < counts.size(); ++k)
    counts[k] = database.number(fmt::format("SELECT count(*) FROM {}", nameOf(k)));
  return counts;
}

std::string textOf(const RowCounts& counts) {
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k)
    text += fmt::format("{}{} {}", k == 0 ? "" : ", ", nameOf(k), counts[k]);
  return text;
}

std::optional<RowCounts> parseRowCounts(const std::string& text) {
  RowCounts counts{};
  std::istringstream words(text);
  std::string name;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (!(words >> name >> counts[k]) || name != nameOf(k)) return std::nullopt;
    if (counts[k] < 0 || counts[k] > kMostRows) return std::nullopt;
    words.ignore(1, ',');
  }
  return counts;
}

}  // namespace capstan::recording
