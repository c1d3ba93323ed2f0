#include "widgets/figures/index_page.h"

#include <cmath>
#include <filesystem>

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
th:first-child, td:first-child { text-align: left; }
</style>
)";

std::string escaped(const std::string& text) {
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

/// A name as part of an address: everything but letters, digits, - . _ as %XX.
std::string address(const std::string& name) {
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

std::string links(const std::vector<std::string>& files, const std::string& base) {
  std::string html = "<div class=\"files\">";
  for (const std::string& file : files) {
    const std::string shown = file.starts_with(base) ? file.substr(base.size()) : file;
    html += "<a href=\"" + address(file) + "\">" + escaped(shown.starts_with('.') ? shown.substr(1) : shown) +
            "</a> ";
  }
  return html + "</div>\n";
}

std::string figureHtml(const IndexFigure& figure) {
  std::string html = "<figure id=\"" + escaped(figure.name) + "\">";
  for (const std::string& file : figure.files)
    if (file.ends_with(".png"))
      html += "<a href=\"" + address(file) + "\"><img src=\"" + address(file) + "\" loading=\"lazy\" alt=\"" +
              escaped(figure.caption) + "\"></a>";
  return html + "\n<figcaption>" + escaped(figure.caption) + "</figcaption>" +
         links(figure.files, figure.name) + "</figure>\n";
}

std::string tableHtml(const IndexTable& entry) {
  const base::Table& table = entry.table;
  std::string html = "<h3>" + escaped(table.title) + "</h3>\n<div class=\"table\"><table><thead><tr>";
  for (const base::TableColumn& column : table.columns)
    html += "<th>" + escaped(column.name + (column.unit.empty() ? "" : " [" + column.unit + "]")) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      html += "<td>" + escaped(i < row.size() ? base::cellText(row[i], table.columns[i]) : "") + "</td>";
    html += "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (!table.note.empty()) html += "<p class=\"note\">" + escaped(table.note) + "</p>\n";
  return html + links(entry.files, {});
}

}  // namespace

std::string indexPage(const IndexPage& page) {
  const std::string title = escaped(page.title);
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n";
  html += std::string(kFiguresMark) + "\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
          title + "</title>\n" + kStyle + "</head><body>\n<h1>" + title + "</h1>\n<p>" +
          escaped(page.software) + "</p>\n";
  if (page.simulated) html += "<p><strong>The robot of these figures is simulated.</strong></p>\n";
  for (const std::string& missing : page.missing) html += "<p class=\"note\">" + escaped(missing) + "</p>\n";
  if (!page.figures.empty()) html += "<h2>Figures</h2>\n<div class=\"figures\">\n";
  for (const IndexFigure& figure : page.figures) html += figureHtml(figure);
  if (!page.figures.empty()) html += "</div>\n";
  if (!page.tables.empty()) html += "<h2>Tables</h2>\n";
  for (const IndexTable& table : page.tables) html += tableHtml(table);
  return html + "</body></html>\n";
}

}  // namespace capstan::widgets
