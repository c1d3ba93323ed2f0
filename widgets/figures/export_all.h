#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/analysis/session_record.h"
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
  bool titles = true;  ///< titles above the panels; false: only in the captions
  std::vector<FigureKind> kinds = {FigureKind::kTrajectory, FigureKind::kParameters, FigureKind::kHistogram,
                                   FigureKind::kBoxplot};
  bool tables = true;
};

/// A drawing of an export: writes files that begin with its name into a folder.
struct ExportDrawing {
  std::string name;
  std::function<IndexFigure(const std::filesystem::path& folder, const PageOptions& pages)> draw;
};

/// What is added to the figures and tables of the results: the comparison of two runs, or the rest of a
/// session (session_extras.h).
struct ExportExtras {
  std::vector<ExperimentFigure> figures = {};
  std::vector<experiments::NamedTable> tables = {};
  std::vector<ExportDrawing> drawings = {};
  std::vector<analysis::SettingsFile> settings = {};
};

struct ExportReport {
  std::vector<std::filesystem::path> files;  ///< files written, index.html last
  std::vector<std::string> missing;          ///< data that `results` lack, in words
  std::size_t figures = 0, tables = 0;
  bool cancelled = false;  ///< the index page lists what was written before
};

/// Writes `extras`, then every figure and table that `results` have data for, into `folder`, which is
/// created: figures as PDF, SVG, PNG and CSV on as many pages as they need (page_layout.h), tables as CSV,
/// LaTeX and Markdown, and index.html with all of them. Files of an earlier export in the folder are
/// replaced; nothing is deleted. Each call draws one figure, so that a window stays responsive. Throws
/// base::InputError as checkExportFolder, for results without anything to draw, and for a file that cannot be
/// written.
class FigureExport {
 public:
  /// Creates the folder, with an index page that says that the export is not finished.
  FigureExport(std::vector<experiments::Results> results, std::filesystem::path folder,
               const ExportOptions& options = {}, ExportExtras extras = {});
  FigureExport(const FigureExport&) = delete;  // figures refer to the results
  FigureExport& operator=(const FigureExport&) = delete;

  bool drawn() const { return report_.figures == drawings_.size(); }           ///< all figures are drawn
  double fraction() const;                                                     ///< share done, 0…1
  const std::string& name() const { return drawings_[report_.figures].name; }  ///< not if drawn()
  /// Draws the next figure; call it on the thread of the application's windows. Throws base::InputError.
  void draw();
  /// Writes tables, settings and index page. Called before all figures are drawn, it reports a cancelled
  /// export.
  ExportReport finish();

 private:
  void writeSettings();

  const std::vector<experiments::Results> results_;
  std::filesystem::path folder_;
  PageOptions pages_;
  std::vector<ExportDrawing> drawings_;
  std::vector<experiments::NamedTable> tables_;
  std::vector<analysis::SettingsFile> settings_;
  ExportReport report_;
  IndexPage page_;
};

/// Runs the whole export. Cancelling `progress` ends it after the present figure.
ExportReport exportAll(const std::vector<experiments::Results>& results, const std::filesystem::path& folder,
                       const ExportOptions& options = {}, base::Progress* progress = nullptr,
                       ExportExtras extras = {});

}  // namespace capstan::widgets
