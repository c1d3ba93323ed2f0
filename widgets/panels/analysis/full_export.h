#pragma once

#include <memory>
#include <vector>

#include "core/analysis/error_run.h"
#include "widgets/figures/export_all.h"
#include "widgets/jobs/job.h"
#include "widgets/jobs/step_export.h"
#include "widgets/panels/analysis/run_picker.h"

namespace capstan::widgets {

/// A chosen run, and its errors as the panel shows them. For results the whole experiment is read.
struct ExportedRun {
  RunChoice choice;
  std::shared_ptr<const analysis::ErrorRun> run = {};
};

/// Exports all figures and tables of runs, and of their comparison, into a folder. Results are read in the
/// background. The result is the path of an index page.
class FullExport : public StepExport {
  Q_OBJECT

 public:
  explicit FullExport(QObject* parent = nullptr);

  /// Starts the export; only if not busy(). Throws base::InputError for a folder that checkExportFolder()
  /// refuses.
  void start(const std::vector<ExportedRun>& runs, ExportExtras extras, const QString& folder,
             const PageOptions& pages);
  /// Stops the export. Figures drawn so far stay, with an index page that reports the cancel.
  void cancel();
  bool busy() const override { return job_.busy() || drawing_ != nullptr; }

 protected:
  void step() override;
  void drop() override { drawing_.reset(); }

 private:
  void onRead(std::vector<experiments::Results> all);
  void finish();

  QString folder_;
  PageOptions pages_;
  ExportExtras extras_;
  QString fault_;
  std::unique_ptr<FigureExport> drawing_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
