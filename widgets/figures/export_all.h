#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/results.h"
#include "core/experiments/tables.h"
#include "widgets/figures/experiment_figures.h"
#include "widgets/figures/export_folder.h"
#include "widgets/figures/index_page.h"
#include "widgets/figures/save_plot.h"

namespace capstan::widgets {

struct ExportOptions {
  PaperSize size;
  bool titles = true;  ///< above the panels; else only in the captions
  std::vector<FigureKind> kinds = {FigureKind::kTrajectory, FigureKind::kParameters, FigureKind::kHistogram,
                                   FigureKind::kBoxplot};
  bool tables = true;
};

/// What an export holds beside the results' own figures and tables: the comparison of two runs.
struct ExportExtras {
  std::vector<ExperimentFigure> figures = {};
  std::vector<experiments::NamedTable> tables = {};
};

struct ExportReport {
  std::vector<std::filesystem::path> files;  ///< written, index.html last
  std::vector<std::string> missing;          ///< what `results` lack, in words
  std::size_t figures = 0, tables = 0;
  bool cancelled = false;  ///< the index page speaks of what came before
};

/// `extras` first, then every figure and table that `results` support, into `folder` (made): figures as PDF,
/// SVG, PNG and CSV, on as many pages as they need (page_layout.h), tables as CSV, LaTeX and Markdown, and
/// index.html with all of them. A former export in the folder is written over, file by file; nothing is
/// deleted. Figure by figure, so that a window stays alive beside it. Throws base::InputError as
/// checkExportFolder, for results without anything to draw, and for a file that cannot be written.
class FigureExport {
 public:
  /// Makes the folder; nothing else is written yet but an index page that reports it.
  FigureExport(std::vector<experiments::Results> results, std::filesystem::path folder,
               const ExportOptions& options = {}, ExportExtras extras = {});
  FigureExport(const FigureExport&) = delete;  // figures refer to the results
  FigureExport& operator=(const FigureExport&) = delete;

  bool drawn() const { return report_.figures == figures_.size(); }           ///< every figure
  double fraction() const;                                                    ///< 0…1
  const std::string& name() const { return figures_[report_.figures].name; }  ///< of the next; not if drawn()
  /// The next figure, on the thread of the application's windows. Throws base::InputError.
  void draw();
  /// Tables and index page. Before all is drawn: the report, and the page, say that it was cancelled.
  ExportReport finish();

 private:
  const std::vector<experiments::Results> results_;
  std::filesystem::path folder_;
  PageOptions pages_;
  std::vector<ExperimentFigure> figures_;
  std::vector<experiments::NamedTable> tables_;
  ExportReport report_;
  IndexPage page_;
};

/// All of it at once; a `progress` that is cancelled ends it behind the figure under way.
ExportReport exportAll(const std::vector<experiments::Results>& results, const std::filesystem::path& folder,
                       const ExportOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::widgets
