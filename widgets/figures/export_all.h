#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "widgets/figures/experiment_figures.h"
#include "widgets/figures/save_plot.h"

namespace capstan::widgets {

struct ExportOptions {
  PaperSize size;
  std::vector<FigureKind> kinds = {FigureKind::kTrajectory, FigureKind::kParameters, FigureKind::kHistogram,
                                   FigureKind::kBoxplot};
  bool tables = true;
};

struct ExportReport {
  std::vector<std::filesystem::path> files;  ///< written, index.html last
  std::vector<std::string> missing;          ///< what `results` lack, in words
  std::size_t figures = 0, tables = 0;
  bool cancelled = false;  ///< the index page speaks of what came before
};

/// Throws base::InputError where exportAll() would not write into `folder`: it is a file, cannot be written,
/// or holds files and no former export.
void checkExportFolder(const std::filesystem::path& folder);

/// Every figure and table that `results` support, into `folder` (made): figures as PDF, SVG, PNG and CSV,
/// tables as CSV, LaTeX and Markdown, and index.html with all of them. A former export in the folder is
/// written over, file by file; nothing is deleted. Throws base::InputError as checkExportFolder, for results
/// without anything to draw, and for a file that cannot be written.
ExportReport exportAll(const std::vector<experiments::Results>& results, const std::filesystem::path& folder,
                       const ExportOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::widgets
