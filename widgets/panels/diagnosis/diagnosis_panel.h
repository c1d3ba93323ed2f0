#pragma once

#include <memory>
#include <optional>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"
#include "widgets/panels/diagnosis/report_export.h"
#include "widgets/panels/diagnosis/running_session.h"
#include "widgets/panels/work/work_panel.h"

class QPushButton;
class QSettings;
class QSplitter;

namespace capstan::widgets {

class CauseTree;
class EffortBox;
class HypothesisCard;
class RecordingPicker;
class ReportPages;
class ToleranceEdit;

/// Shows where a robot model, simulated on the inputs of recordings, disagrees with the measurements; the
/// causes; and how much the error falls if they are modelled. Verdict and causes are on top, details below.
/// core/diagnosis computes everything, in the background.
class DiagnosisPanel : public WorkPanel {
  Q_OBJECT

 public:
  /// `run` computes the reports: runDiagnosis, or a substitute in tests.
  explicit DiagnosisPanel(DiagnosisRun run, QWidget* parent = nullptr);
  ~DiagnosisPanel() override;

  void setTheme(const Theme& theme);
  /// Offers a complete recording of the session; `words`: text of the button that chooses it; `read_as`: its
  /// units. Empty path: none.
  void offer(const QString& path, const QString& words, const QString& read_as = {});
  /// Chooses the recording that the window has opened, its robot file (empty: its own) and its units, unless
  /// the user has chosen others or a report of the former one is shown.
  void preselect(const QString& path, const QString& robot, const QString& read_as = {});
  /// Sets the running session, whose robot the extended robot may replace.
  void setSession(const RunningSession& session);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);

  void choose(const DiagnosisChoice& choice);
  DiagnosisChoice choice() const;
  /// Starts a diagnosis; cancels one that is running.
  void diagnose();
  void cancel() override;
  bool busy() const override { return job_.busy() || export_.busy(); }
  /// Shows a report, as diagnose() does when it is finished.
  void showReport(diagnosis::Report report);
  /// The report of the chosen recordings and robot; null: none yet, or only one of another choice.
  const diagnosis::Report* report() const { return of_ == choice() ? report_.get() : nullptr; }
  /// Writes the extended robot to a robot file. The panel shows errors.
  void saveRobot(const QString& path);
  /// Writes the trajectory of the proposed experiment. The panel shows errors.
  void saveTrajectory(const QString& path);
  /// Writes a page with figures, report.json and robot.yaml into `folder`. The panel shows the result or the
  /// error.
  void exportTo(const QString& folder);

  RecordingPicker& picker() { return *picker_; }
  ToleranceEdit& tolerance() { return *tolerance_; }
  CauseTree& causes() { return *causes_; }
  ReportPages& pages() { return *pages_; }

 signals:
  /// Requests that the session uses `robot`; `summary` lists the differences from the former one.
  void robotChosen(const capstan::robot::Description& robot, const QString& summary);
  void robotSaved(const QString& path);
  void exported(const QString& index);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* makeInput();
  QWidget* makeBody();
  void onInput();
  QString ofWords() const;
  bool canDiagnose() const;
  void makeButtons();
  void diagnoseOrCancel();
  void useRobot();
  void askFile();
  void askTrajectory();
  void askFolder();
  void onCause();
  void showCard();
  void onCandidate();
  void showVerdict();
  void refresh();

  Theme theme_ = Theme::dark();
  DiagnosisRun run_;
  std::shared_ptr<const diagnosis::Report> report_;
  DiagnosisChoice of_;  ///< choice that the report belongs to
  QString failed_;      ///< error why there is no report; empty: none
  QString said_;
  RunningSession session_;
  QStringList preselected_;  ///< recording that preselect() has chosen
  bool user_split_ = false;
  RecordingPicker* picker_;
  ToleranceEdit* tolerance_;
  EffortBox* effort_;
  QSplitter *split_, *top_;
  CauseTree* causes_;
  HypothesisCard* card_;
  ReportPages* pages_;
  QPushButton *diagnose_, *save_, *use_, *next_, *page_;
  ReportExport export_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
