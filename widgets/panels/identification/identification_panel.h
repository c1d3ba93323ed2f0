#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>
#include <memory>

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

class ParameterChoice;
class ParameterTable;
class TracePlot;

/// Identification beside the running session: choose parameters, collect, see value ± σ, trace and advice,
/// refine, accept or discard. What it shows is thought by identification::LiveIdentification; runs are made
/// in the background, one at a time.
class IdentificationPanel : public QWidget {
  Q_OBJECT

 public:
  explicit IdentificationPanel(QWidget* parent = nullptr);
  ~IdentificationPanel() override;

  void setTheme(const Theme& theme);
  /// A session was opened: whatever was under way is given up.
  void begin(const tracking::SourceInfo& source);
  /// The session uses `robot` from now on, not by this panel's doing: found by `origin`, it is the one that
  /// values begin with, and what was under way on top of the former is given up. Undo takes it back.
  void useRobot(const robot::Description& robot, const QString& origin);
  /// Collecting ends with the session.
  void showStatus(const live::RunStatus& status);
  /// The accepted robot and its changes, as a robot file. What goes wrong is said on the panel.
  void saveRobot(const QString& path);

  const identification::LiveIdentification& live() const { return live_; }
  bool busy() const { return job_.busy(); }
  ParameterChoice& choice() { return *choice_; }
  ParameterTable& table() { return *table_; }
  TracePlot& trace() { return *trace_; }
  QString words() const;
  QString advice() const;
  QString changes() const;

 signals:
  /// Samples are to go there from now on; null: nowhere.
  void listenerRequested(const std::shared_ptr<capstan::identification::LiveRecording>& sink);
  /// The pipeline is to use `robot`; `summary` says what differs.
  void robotChosen(const capstan::robot::Description& robot, const QString& summary);
  void robotSaved(const QString& path);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  QPushButton* button(const QString& name, const QString& tip, void (IdentificationPanel::*pressed)());
  void addPages(QVBoxLayout* column);
  void addButtons(QVBoxLayout* column);
  void addKeys();
  void startOrStop();
  void refine();
  void discard();
  void accept();
  void revert();
  void askFile();
  void overtake();
  void poll();
  void refresh();
  QString stateWords() const;
  void showChosen();
  void showButtons();

  Theme theme_ = Theme::dark();
  identification::LiveIdentification live_;
  robot::Description in_use_;
  std::string title_;  ///< of the session
  QString said_;
  bool open_ = false, ended_ = false;
  std::shared_ptr<identification::LiveRecording> sink_;
  std::vector<identification::LiveRow> rows_;   ///< as the table shows them
  std::pair<std::uint64_t, int> drawn_{0, -1};  ///< report and parameter that the trace shows
  QElapsedTimer clock_;
  QTimer polls_;
  QLabel *words_, *advice_;
  QStackedWidget* pages_;
  ParameterChoice* choice_;
  QWidget* results_;
  ParameterTable* table_;
  TracePlot* trace_;
  QPlainTextEdit* changes_;
  QProgressBar* progress_;
  QPushButton *start_, *refine_, *discard_, *accept_, *revert_, *save_;
  Job job_;  ///< last: ends before what it reports to
};

}  // namespace capstan::widgets
