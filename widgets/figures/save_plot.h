#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "widgets/figures/figure.h"
#include "widgets/figures/page_layout.h"
#include "widgets/figures/paper_size.h"

namespace capstan::widgets {

/// File endings of figures.
inline const std::vector<std::string> kImageEndings = {".pdf", ".svg", ".png"};

/// Writes `plot` to a file by its ending: .png (300 dpi), .pdf or .svg (vectors, text as text), in the given
/// physical size. The plot must have been laid out for size.dots(). An existing file is replaced when the new
/// one is complete. Needs no display. Throws base::InputError for another ending or a path that cannot be
/// written.
void savePlot(QCustomPlot& plot, const std::filesystem::path& path, PaperSize size, const QString& title);

/// Writes the figure in the light theme, on as many pages as it needs (page_layout.h): base.pdf, base.svg and
/// base.png (those in `endings`), for several pages base-page-1.pdf, base-page-2.pdf …; and its numbers as
/// base*.csv. Returns the files written. Throws base::InputError.
std::vector<std::filesystem::path> exportFigure(const Figure& figure, const std::filesystem::path& base,
                                                const PageOptions& options = {},
                                                const std::vector<std::string>& endings = kImageEndings);

}  // namespace capstan::widgets
