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

/// From tables of tip poses to a correction of commands: what is read, excluded and why, trained, and worth.
/// Everything is computed by core/learning and core/experiments, in the background, one thing at a time.
class LearningPanel : public WorkPanel {
  Q_OBJECT

 public:
  explicit LearningPanel(LearningSettings settings = {}, QWidget* parent = nullptr);
  ~LearningPanel() override;

  void setTheme(const Theme& theme);
  /// Of what is begun from now on.
  void setSettings(const LearningSettings& settings) { settings_ = settings; }
  void save(QSettings& settings) const;
  /// Tables are read when the panel is looked at.
  void restore(const QSettings& settings);

  /// Reads the tables; what was under way is given up, what was learned of others is forgotten.
  void choose(const LearningChoice& choice);
  const LearningChoice& choice() const;
  void train();
  void runAblation();
  void runCurve();
  void cancel() override;
  bool busy() const override { return job_.busy() || export_.busy(); }
  const LearningResults& results() const { return results_; }
  /// Figures and tables in `folder`; how it ends, and why not, is said on the panel.
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
  Doing doing_ = Doing::kNothing;  ///< newest piece of work, under way or ended
  bool read_again_ = false;        ///< tables were chosen while another piece of work had to end
  QString failed_;                 ///< why the newest work failed; empty: it did not
  QString said_;
  TablePicker* picker_;
  LearningPages* pages_;
  QPushButton *train_, *export_button_, *model_button_;
  LearningExport export_;
  Job job_;  ///< last: ends before what it reports to
};

}  // namespace capstan::widgets
