#include "widgets/figures/html_parts.h"

#include <algorithm>
#include <cmath>

namespace capstan::widgets {

namespace {

constexpr const char* kStyle = R"(<style>
:root { color-scheme: light dark; --ground: #fff; --text: #15181c; --quiet: #56606b; --line: #c4cad1; --link: #1f6fc0; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #14171b; --text: #eef1f4; --quiet: #a3adb8; --line: #39414a; --link: #6fb1f0; }
}
body { background: var(--ground); color: var(--text); font: 16px/1.5 "DejaVu Sans", sans-serif; margin: 2em auto;
       max-width: 76em; padding: 0 1em; }
a { color: var(--link); }
.figures { display: grid; gap: 1.5em; grid-template-columns: repeat(auto-fill, minmax(24em, 1fr)); }
figure { border: 1px solid var(--line); border-radius: 6px; margin: 0; padding: 0.8em; }
figure img { background: #fff; height: auto; width: 100%; }
figcaption { font-size: 0.9em; }
.files, .note { color: var(--quiet); font-size: 0.9em; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: 0.15em 0.8em; text-align: right; }
th:first-child, td:first-child, .words { text-align: left; }
.bar { background: linear-gradient(to right, #009e7340 var(--share), transparent var(--share)); min-width: 6em; }
</style>
)";

/// Columns of words are left-aligned.
bool isWords(const base::Table& table, std::size_t column) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return column < row.size() && !row[column].text.empty(); });
}

std::string cellHtml(const base::Table& table, const std::vector<base::TableCell>& row, std::size_t column,
                     bool bar) {
  const base::TableCell cell = column < row.size() ? row[column] : base::TableCell{};
  std::string begin = isWords(table, column) ? "<td class=\"words\">" : "<td>";
  if (bar && std::isfinite(cell.number))
    begin = "<td class=\"bar\" style=\"--share:" +
            std::to_string(std::clamp(static_cast<int>(std::lround(cell.number)), 0, 100)) + "%\">";
  const std::string text = column < row.size() ? base::cellText(cell, table.columns[column]) : "";
  return begin + htmlEscaped(text) + "</td>";
}

}  // namespace

std::string htmlEscaped(const std::string& text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string htmlAddress(const std::string& name) {
  constexpr const char* kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || c == '_';
    if (plain)
      out += c;
    else
      out += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
  }
  return out;
}

std::string htmlHead(const std::string& title, const std::string& mark, const std::string& style) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n" + mark +
                     "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
                     htmlEscaped(title) + "</title>\n" + kStyle;
  if (!style.empty()) html += "<style>\n" + style + "</style>\n";
  return html + "</head><body>\n";
}

std::string htmlTable(const base::Table& table, std::optional<std::size_t> bars) {
  std::string html = "<h3>" + htmlEscaped(table.title) + "</h3>\n<div class=\"table\"><table><thead><tr>";
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const base::TableColumn& column = table.columns[i];
    html += (isWords(table, i) ? "<th class=\"words\">" : "<th>") +
            htmlEscaped(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]")) + "</th>";
  }
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i) html += cellHtml(table, row, i, bars == i);
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (!table.note.empty()) html += "<p class=\"note\">" + htmlEscaped(table.note) + "</p>\n";
  return html;
}

}  // namespace capstan::widgets
