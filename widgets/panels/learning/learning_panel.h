#pragma once

#include "core/learning/model/correction_file.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/learning/learning_export.h"
#include "widgets/panels/learning/learning_work.h"
#include "widgets/panels/work/work_panel.h"

class QPushButton;
class QSettings;

namespace capstan::widgets {

class LearningPages;
class TablePicker;

/// Learns a correction of commands from tables of tip poses: data read, data excluded with reasons, training,
/// and evaluation. core/learning and core/experiments compute everything, in the background, one job at a
/// time.
class LearningPanel : public WorkPanel {
  Q_OBJECT

 public:
  explicit LearningPanel(LearningSettings settings = {}, QWidget* parent = nullptr);
  ~LearningPanel() override;

  void setTheme(const Theme& theme);
  /// Sets the settings of the work that is started from now on.
  void setSettings(const LearningSettings& settings) { settings_ = settings; }
  void save(QSettings& settings) const;
  /// Restores the choice. Its tables are read when the panel is shown.
  void restore(const QSettings& settings);

  /// Reads the tables; cancels running work, and discards results of other tables.
  void choose(const LearningChoice& choice);
  const LearningChoice& choice() const;
  void train();
  void runAblation();
  void runCurve();
  void cancel() override;
  bool busy() const override { return job_.busy() || export_.busy(); }
  const LearningResults& results() const { return results_; }
  /// Writes figures and tables into `folder`. The panel shows the result or the error.
  void exportTo(const QString& folder);
  void saveModel(const QString& path);

  LearningPages& pages() { return *pages_; }
  TablePicker& picker() { return *picker_; }

 signals:
  void exported(const QString& folder);
  void modelSaved(const QString& path);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  learning::CorrectionSource source() const;
  enum class Doing { kNothing, kReading, kTraining, kAblation, kCurve };

  void makeButtons();
  void read();
  void begin(Doing doing, const QString& words);
  void trainOrCancel();
  void askFolder();
  void askModel();
  void onEnded();
  bool ready() const { return results_.stages && !busy(); }
  QString failedHeadline() const;
  void showState();
  void refresh();

  Theme theme_ = Theme::dark();
  LearningSettings settings_;
  LearningResults results_;
  Doing doing_ = Doing::kNothing;  ///< the latest work, running or ended
  bool read_again_ = false;        ///< true: tables were chosen during a job, and are read after it
  QString failed_;                 ///< error of the latest work; empty: none
  QString said_;
  TablePicker* picker_;
  LearningPages* pages_;
  QPushButton *train_, *export_button_, *model_button_;
  LearningExport export_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
