#pragma once

#include <memory>

#include "widgets/figures/diagnosis_export.h"
#include "widgets/jobs/step_export.h"

namespace capstan::widgets {

/// Exports a report as a page with figures, JSON and robot file. The result is the path of the page.
class ReportExport : public StepExport {
  Q_OBJECT

 public:
  explicit ReportExport(QObject* parent = nullptr) : StepExport(parent) {}

  /// Starts the export; only if not busy(). Throws base::InputError for a folder that DiagnosisExport
  /// refuses.
  void start(const diagnosis::Report& report, const std::string& robot, const QString& folder);
  /// Stops the export. Figures drawn so far stay, with a page that reports the cancel.
  void cancel() { endCancelled(folder_); }
  bool busy() const override { return drawing_ != nullptr; }

 protected:
  void step() override;
  void drop() override { drawing_.reset(); }

 private:
  QString folder_;
  std::unique_ptr<DiagnosisExport> drawing_;
};

}  // namespace capstan::widgets
