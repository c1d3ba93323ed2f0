#include "widgets/figures/index_page.h"

#include "widgets/figures/html_parts.h"

namespace capstan::widgets {

namespace {

std::string links(const std::vector<std::string>& files, const std::string& base) {
  std::string html = "<div class=\"files\">";
  for (const std::string& file : files) {
    const std::string shown = file.starts_with(base) ? file.substr(base.size()) : file;
    html += "<a href=\"" + htmlAddress(file) + "\">" +
            htmlEscaped(shown.starts_with('.') ? shown.substr(1) : shown) + "</a> ";
  }
  return html + "</div>\n";
}

std::string figureHtml(const IndexFigure& figure) {
  std::string html = "<figure id=\"" + htmlEscaped(figure.name) + "\">";
  for (const std::string& file : figure.files)
    if (file.ends_with(".png"))
      html += "<a href=\"" + htmlAddress(file) + "\"><img src=\"" + htmlAddress(file) +
              "\" loading=\"lazy\" alt=\"" + htmlEscaped(figure.caption) + "\"></a>";
  return html + "\n<figcaption>" + htmlEscaped(figure.caption) + "</figcaption>" +
         links(figure.files, figure.name) + "</figure>\n";
}

}  // namespace

std::string indexPage(const IndexPage& page) {
  std::string html = htmlHead(page.title, kFiguresMark) + "<h1>" + htmlEscaped(page.title) + "</h1>\n<p>" +
                     htmlEscaped(page.software) + "</p>\n";
  if (page.simulated) html += "<p><strong>The robot of these figures is simulated.</strong></p>\n";
  for (const std::string& missing : page.missing)
    html += "<p class=\"note\">" + htmlEscaped(missing) + "</p>\n";
  if (!page.figures.empty()) html += "<h2>Figures</h2>\n<div class=\"figures\">\n";
  for (const IndexFigure& figure : page.figures) html += figureHtml(figure);
  if (!page.figures.empty()) html += "</div>\n";
  if (!page.tables.empty()) html += "<h2>Tables</h2>\n";
  for (const IndexTable& table : page.tables) html += htmlTable(table.table) + links(table.files, {});
  for (const IndexFiles& one : page.others)
    html += "<h2>" + htmlEscaped(one.heading) + "</h2>\n" + links(one.files, {});
  return html + "</body></html>\n";
}

}  // namespace capstan::widgets
