#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/page_layout.h"
#include "widgets/figures/paper_size.h"

namespace capstan::widgets {

/// Endings that figures are written with.
inline const std::vector<std::string> kImageEndings = {".pdf", ".svg", ".png"};

/// Draws `plot` into a file by its ending: .png (300 dpi), .pdf or .svg (vectors, text as text), of the
/// physical size given. The plot must have been laid out for size.dots(). A file is replaced when the new one
/// is whole. Needs no display. Throws base::InputError for another ending or an unwritable place.
void savePlot(QCustomPlot& plot, const std::filesystem::path& path, PaperSize size, const QString& title);

/// The figure on paper, light whatever its theme on screen, on as many pages as it needs (page_layout.h):
/// base.pdf, base.svg and base.png (of `endings`), of several pages base-page-1.pdf, base-page-2.pdf …; and
/// its numbers as base*.csv. Returns what was written. Throws base::InputError.
std::vector<std::filesystem::path> exportFigure(const Figure& figure, const std::filesystem::path& base,
                                                const PageOptions& options = {},
                                                const std::vector<std::string>& endings = kImageEndings);

}  // namespace capstan::widgets
