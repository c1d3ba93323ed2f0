#pragma once

#include <memory>
#include <optional>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"
#include "widgets/panels/diagnosis/diagnosis_choice.h"
#include "widgets/panels/diagnosis/report_export.h"
#include "widgets/panels/work/work_panel.h"

class QPushButton;
class QSettings;
class QSplitter;

namespace capstan::widgets {

class CauseTree;
class HypothesisCard;
class RecordingPicker;
class ReportPages;

/// What the simulation of a robot gets wrong in recordings, why, and what it is worth to know: verdict and
/// causes on top, below them what they look like. Everything is thought by core/diagnosis, in the background.
class DiagnosisPanel : public WorkPanel {
  Q_OBJECT

 public:
  /// `run` makes the reports: runDiagnosis, or what a test has in its place.
  explicit DiagnosisPanel(DiagnosisRun run, QWidget* parent = nullptr);
  ~DiagnosisPanel() override;

  void setTheme(const Theme& theme);
  /// A recording of the session, once it is complete: `words` on the button that takes it. Empty: none.
  void offer(const QString& path, const QString& words);
  /// Joints of the running session's robot, which may take the extended robot's place; 0: no session.
  void setSessionJoints(int joints);
  void save(QSettings& settings) const;
  void restore(const QSettings& settings);

  void choose(const DiagnosisChoice& choice);
  const DiagnosisChoice& choice() const;
  /// Begins; what was under way is given up.
  void diagnose();
  void cancel() override;
  bool busy() const override { return job_.busy() || export_.busy(); }
  /// Shows a report, as diagnose() does when it is done.
  void showReport(diagnosis::Report report);
  /// That of the recordings and the robot chosen; null: none yet, or of others.
  const diagnosis::Report* report() const { return of_ == choice() ? report_.get() : nullptr; }
  /// The extended robot as a robot file; what goes wrong is said on the panel.
  void saveRobot(const QString& path);
  /// A page with figures, report.json and robot.yaml in `folder`; how it ends, and why not, is said on the
  /// panel.
  void exportTo(const QString& folder);

  RecordingPicker& picker() { return *picker_; }
  CauseTree& causes() { return *causes_; }
  ReportPages& pages() { return *pages_; }

 signals:
  /// The session is to use `robot`; `summary` says what it has beyond the former one.
  void robotChosen(const capstan::robot::Description& robot, const QString& summary);
  void robotSaved(const QString& path);
  void exported(const QString& index);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QWidget* makeBody();
  void makeButtons();
  void diagnoseOrCancel();
  void useRobot();
  void askFile();
  void askFolder();
  void onCause();
  void showCard();
  void onCandidate();
  void showVerdict();
  void refresh();

  Theme theme_ = Theme::dark();
  DiagnosisRun run_;
  std::shared_ptr<const diagnosis::Report> report_;
  DiagnosisChoice of_;  ///< what the report is of
  QString failed_;      ///< why there is no report; empty: nothing failed
  QString said_;
  int session_joints_ = 0;
  bool user_split_ = false;
  RecordingPicker* picker_;
  QSplitter *split_, *top_;
  CauseTree* causes_;
  HypothesisCard* card_;
  ReportPages* pages_;
  QPushButton *diagnose_, *save_, *use_, *page_;
  ReportExport export_;
  Job job_;  ///< last: ends before what it reports to
};

}  // namespace capstan::widgets
