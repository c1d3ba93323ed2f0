#pragma once

#include <QObject>
#include <QTimer>
#include <memory>
#include <vector>

#include "core/analysis/error_run.h"
#include "widgets/figures/export_all.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/analysis/run_picker.h"

namespace capstan::widgets {

/// A chosen run, and its errors as the panel shows them. For results the whole experiment is read.
struct ExportedRun {
  RunChoice choice;
  std::shared_ptr<const analysis::ErrorRun> run = {};
};

/// Exports all figures and tables of runs, and of their comparison, into a folder with an index page. Results
/// are read in the background. Figures are widgets, so they are drawn on the window's thread, one at a time,
/// when it is idle.
class FullExport : public QObject {
  Q_OBJECT

 public:
  explicit FullExport(QObject* parent = nullptr);

  /// Starts the export; only if not busy(). Throws base::InputError for a folder that checkExportFolder()
  /// refuses.
  void start(const std::vector<ExportedRun>& runs, ExportExtras extras, const QString& folder,
             const PageOptions& pages);
  /// Stops the export. Figures drawn so far stay, with an index page that reports the cancel.
  void cancel();
  bool busy() const { return job_.busy() || drawing_ != nullptr; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// The export has ended. `index`: path of the page, empty if there is none; `words`: what was written, or
  /// the error.
  void ended(const QString& index, const QString& words);

 private:
  void onRead(std::vector<experiments::Results> all);
  void drawNext();
  void finish();
  void end(const QString& index, const QString& words);

  QString folder_;
  PageOptions pages_;
  ExportExtras extras_;
  QString fault_;
  std::unique_ptr<FigureExport> drawing_;
  QTimer next_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
