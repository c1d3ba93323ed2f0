#include "widgets/figures/page_layout.h"

#include <QResizeEvent>
#include <algorithm>
#include <map>

#include "widgets/figures/panel_figure.h"

namespace capstan::widgets {

namespace {

using Panels = std::vector<std::size_t>;

/// Lays out a plot that may not be on screen and then gets no resize event.
void resizePlot(QCustomPlot& plot, QSize size) {
  plot.setMinimumSize(0, 0);
  QResizeEvent event(size, plot.size());
  plot.resize(size);
  QCoreApplication::sendEvent(&plot, &event);
}

PanelFigure& panelsOf(Figure& figure) { return dynamic_cast<PanelFigure&>(figure.canvas()); }

std::unique_ptr<Figure> page(const Figure& figure, const PageOptions& options) {
  auto paper = figure.copy();
  paper->setTheme(Theme::light());
  panelsOf(*paper).setYielding(false);
  panelsOf(*paper).setTitled(options.titles);
  resizePlot(paper->canvas(), options.size.dots());
  return paper;
}

using Pages = std::vector<std::unique_ptr<Figure>>;

std::vector<Panels> groupsOf(const PanelFigure& figure) {
  std::map<int, Panels> groups;
  for (std::size_t i = 0; i < figure.panels().size(); ++i) groups[figure.panels()[i].group].push_back(i);
  std::vector<Panels> all;
  for (auto& [group, panels] : groups) all.push_back(std::move(panels));
  return all;
}

/// One page per panel, group after group.
std::vector<Panels> apart(const std::vector<Panels>& groups) {
  std::vector<Panels> all;
  for (const Panels& group : groups)
    for (const std::size_t panel : group) all.push_back({panel});
  return all;
}

Pages pagesFor(const Figure& figure, const PageOptions& options, const std::vector<Panels>& parts) {
  Pages pages;
  for (const Panels& part : parts) {
    pages.push_back(page(figure, options));
    panelsOf(*pages.back()).setShown(part);
  }
  return pages;
}

bool allFit(const Pages& pages) {
  return std::all_of(pages.begin(), pages.end(), [](const auto& one) { return panelsOf(*one).fits(); });
}

}  // namespace

Pages pagesOf(const Figure& figure, const PageOptions& options) {
  Pages pages;
  pages.push_back(page(figure, options));
  if (allFit(pages)) return pages;
  const std::vector<Panels> groups = groupsOf(panelsOf(*pages.front()));
  pages = pagesFor(figure, options, groups);
  if (allFit(pages)) return pages;
  pages = pagesFor(figure, options, apart(groups));
  for (const auto& one : pages) panelsOf(*one).setYielding(true);
  return pages;
}

}  // namespace capstan::widgets
