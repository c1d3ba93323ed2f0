#pragma once

#include <memory>
#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/paper_size.h"

namespace capstan::widgets {

/// How a figure is put on paper.
struct PageOptions {
  PageOptions(PaperSize paper = {}, bool titled = true) : size(paper), titles(titled) {}

  PaperSize size;
  bool titles;  ///< title and note stand above the panels; else only in the caption
};

/// The figure on light pages, laid out for size.dots(): on one where every panel has its least height
/// (PanelFigure::kLeastAxesHeight) and all words have room; else on a page for each group of panels, as those
/// of one joint; where these do not fit either, on a page for each panel, where words give way if need be.
std::vector<std::unique_ptr<Figure>> pagesOf(const Figure& figure, const PageOptions& options);

}  // namespace capstan::widgets
