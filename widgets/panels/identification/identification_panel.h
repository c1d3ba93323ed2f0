#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <memory>

#include "core/identification/better_motion.h"
#include "core/identification/live_identification.h"
#include "core/live/runner.h"
#include "widgets/figures/theme.h"
#include "widgets/jobs/job.h"

class QLabel;
class QPlainTextEdit;
class QProgressBar;
class QPushButton;
class QStackedWidget;
class QVBoxLayout;

namespace capstan::widgets {

class MotionOffer;
class ParameterChoice;
class ParameterTable;
class TracePlot;

/// Identification during the running session: choose parameters, collect data, see value ± σ, trace and
/// advice, refine, accept or discard. identification::LiveIdentification holds the state; its runs are
/// computed in the background, one at a time.
class IdentificationPanel : public QWidget {
  Q_OBJECT

 public:
  explicit IdentificationPanel(QWidget* parent = nullptr);
  ~IdentificationPanel() override;

  void setTheme(const Theme& theme);
  /// A session was opened: cancels work that is running.
  void begin(const tracking::SourceInfo& source);
  /// The session uses `robot` from now on, chosen outside this panel and found by `origin`. New values start
  /// from `robot`, and work that started from the former robot is cancelled. Undo restores the robot of the
  /// robot file.
  void useRobot(const robot::Description& robot, const QString& origin);
  /// Shows the state of the session; ends collecting when it ends.
  void showStatus(const live::RunStatus& status);
  /// Writes the accepted robot and its changes to a robot file. The panel shows errors.
  void saveRobot(const QString& path);

  const identification::LiveIdentification& live() const { return live_; }
  bool busy() const { return job_.busy(); }
  ParameterChoice& choice() { return *choice_; }
  ParameterTable& table() { return *table_; }
  TracePlot& trace() { return *trace_; }
  QString words() const;
  QString advice() const;
  QString changes() const;
  MotionOffer& motionOffer() { return *offer_; }

 signals:
  /// Requests that samples are sent to `sink` from now on; null: to nobody.
  void listenerRequested(const std::shared_ptr<capstan::identification::LiveRecording>& sink);
  /// Requests that the pipeline uses `robot`; `summary` lists the differences.
  void robotChosen(const capstan::robot::Description& robot, const QString& summary);
  void robotSaved(const QString& path);
  /// Requests that the robot is driven along a motion.
  void motionRequested(const capstan::identification::SinusoidMotion& motion, const QString& words);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QPushButton* button(const QString& name, const QString& tip, void (IdentificationPanel::*pressed)());
  QWidget* makeBody();
  void addPages(QVBoxLayout* column);
  void addButtons(QVBoxLayout* column);
  void addKeys();
  void startOrStop();
  void refine();
  void discard();
  void accept();
  void revert();
  void askFile();
  void propose();
  void overtake();
  void poll();
  void refresh();
  QString stateWords() const;
  void showChosen();
  void showButtons();

  Theme theme_ = Theme::dark();
  identification::LiveIdentification live_;
  robot::Description in_use_;
  std::string title_;  ///< title of the session
  QString said_;
  bool open_ = false, ended_ = false;
  std::shared_ptr<identification::LiveRecording> sink_;
  std::vector<identification::LiveRow> rows_;   ///< rows shown in the table
  std::pair<std::uint64_t, int> drawn_{0, -1};  ///< report and parameter of the drawn trace
  QElapsedTimer clock_;
  QTimer polls_;
  QLabel *words_, *advice_;
  MotionOffer* offer_;
  QStackedWidget* pages_;
  ParameterChoice* choice_;
  QWidget* results_;
  ParameterTable* table_;
  TracePlot* trace_;
  QPlainTextEdit* changes_;
  QProgressBar* progress_;
  QPushButton *start_, *refine_, *discard_, *accept_, *revert_, *save_;
  Job job_;  ///< last member: destroyed before the members it reports to
};

}  // namespace capstan::widgets
