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

/// A chosen run, and its errors as the panel shows them. Results of an experiment are read whole.
struct ExportedRun {
  RunChoice choice;
  std::shared_ptr<const analysis::ErrorRun> run = {};
};

/// All figures and tables of runs, and of their comparison, into a folder with an index page. Results are
/// read in the background; figures, which are widgets, are drawn on the window's thread, one each time
/// nothing else waits.
class FullExport : public QObject {
  Q_OBJECT

 public:
  explicit FullExport(QObject* parent = nullptr);

  /// Only if not busy(). Throws base::InputError for a folder that checkExportFolder() refuses.
  void start(const std::vector<ExportedRun>& runs, ExportExtras extras, const QString& folder,
             const PageOptions& pages);
  /// What is drawn already stays, with an index page that reports it.
  void cancel();
  bool busy() const { return job_.busy() || drawing_ != nullptr; }

 signals:
  void progressed(double fraction, const QString& doing);
  /// It is no longer busy. `index`: the page, empty where there is none; `words`: what was written, or why
  /// not.
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
  Job job_;  ///< last: ends before what it reports to
};

}  // namespace capstan::widgets
