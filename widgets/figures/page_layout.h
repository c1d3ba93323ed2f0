#pragma once

#include <memory>
#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/paper_size.h"

namespace capstan::widgets {

/// Options for a figure on paper.
struct PageOptions {
  PageOptions(PaperSize paper = {}, bool titled = true) : size(paper), titles(titled) {}

  PaperSize size;
  bool titles;  ///< title and note above the panels; false: only in the caption
};

/// The figure on pages in the light theme, laid out for size.dots(). It is one page if every panel then has
/// its least height (PanelFigure::kLeastAxesHeight) and all texts have room; else one page per group of
/// panels, for example of one joint; if a group does not fit its page, one page per panel, where texts are
/// omitted if necessary.
std::vector<std::unique_ptr<Figure>> pagesOf(const Figure& figure, const PageOptions& options);

}  // namespace capstan::widgets
