#pragma once

#include <memory>

#include "core/experiments/correction_experiment.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/work/work_panel.h"

class QSettings;
class QSplitter;
class QTextBrowser;

namespace capstan::widgets {

class ExperimentPicker;
class FigureSheet;

/// Experiments E to H of the GPR paper: runs one in the background, shows its figure and its comparison with
/// the published numbers, and exports both. It calls the same function of core as `capstan-cli experiment E`.
class ExperimentsPanel : public WorkPanel {
  Q_OBJECT

 public:
  explicit ExperimentsPanel(experiments::CorrectionExperimentOptions options = {}, QWidget* parent = nullptr);
  ~ExperimentsPanel() override;

  void setTheme(const Theme& theme);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);

  /// Runs the chosen experiment; cancels the running one.
  void runOrCancel();
  void cancel() override;
  bool busy() const override { return job_.busy(); }
  /// Calls writeExperiment() for `folder`; the panel shows errors.
  void exportTo(const QString& folder);

  ExperimentPicker& picker() { return *picker_; }
  const experiments::CorrectionExperimentResults* results() const { return results_.get(); }

 signals:
  void exported(const QString& folder);

 private:
  void take(experiments::CorrectionExperimentResults results);
  void askFolder();
  void refresh();

  const experiments::CorrectionExperimentOptions options_;  ///< options that the picker does not set
  std::unique_ptr<experiments::CorrectionExperimentResults> results_;
  QString said_, title_;
  ExperimentPicker* picker_;
  QSplitter* body_;
  FigureSheet* figure_;
  QTextBrowser* comparison_;
  QPushButton *run_, *export_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
