#pragma once

#include <QMainWindow>
#include <QSettings>
#include <map>
#include <optional>

#include "core/live/pause_watch.h"
#include "core/tracking/side_watch.h"
#include "widgets/figures/joint_figure.h"
#include "widgets/shell/session_link.h"

class QDockWidget;
class QMenuBar;
class QSplitter;
class QStackedWidget;

namespace capstan::widgets {

class AnalysisPages;
class AnalysisPanel;
class CompareController;
class IdentificationPanel;
class DiagnosisPanel;
class ExportController;
class ErrorsPanel;
class HelpWindow;
class LayoutController;
class LearningPanel;
class MessageBar;
class MonitorController;
class NotesPanel;
class OcclusionController;
class OcclusionPanel;
class RegistrationPanel;
class ReplayBar;
class SceneView;
class SessionBar;
class SettingsUndo;
class StatusLine;
class StereoView;

/// The workstation's window: camera images and scene left, joint plots in the middle, occlusion,
/// identification, errors and notes right, status below. `settings`: path of an .ini file for layout, theme,
/// folders and last source; empty: the user's own.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(const QString& settings = {}, QWidget* parent = nullptr);
  ~MainWindow() override;

  void open(const SourceChoice& choice);
  SourceChoice lastSource() const { return choice_; }
  void setThemeNamed(const QString& name);
  QString themeName() const { return theme_.name; }
  SessionLink& link() { return link_; }
  JointFigure& figure() { return *figure_; }
  NotesPanel& notes() { return *notes_; }
  ErrorsPanel& errors() { return *errors_; }
  SessionBar& bar() { return *bar_; }
  IdentificationPanel& identification() { return *identification_; }
  AnalysisPanel& analysis();  ///< errors of runs
  MonitorController& monitor() { return *monitor_; }
  DiagnosisPanel& diagnosis() { return *diagnosis_; }
  LearningPanel& learning() { return *learning_; }
  ExportController& exports() { return *export_; }
  CompareController& comparison() { return *compare_; }
  LayoutController& layouts() { return *layouts_; }
  MessageBar& news() { return *news_; }
  /// Text of the message bar; empty: no message, or closed.
  QString message() const;
  QAction* action(const QString& name) const { return findChild<QAction*>(name); }

 signals:
  void themeChanged(const Theme& theme);

 protected:
  void showEvent(QShowEvent* event) override;
  void closeEvent(QCloseEvent* event) override;

 private:
  /// Connects a new view to the theme.
  template <class View>
  View* themed(View* view) {
    connect(this, &MainWindow::themeChanged, view, &View::setTheme);
    return view;
  }
  QMenuBar* addBars();
  void addDocks();
  void connectBar();
  void connectLink();
  void connectNotes();
  void askUnits(const recording::ImplausibleUnits& refused, const SourceChoice& choice);
  void onOpened(const tracking::SourceInfo& info, const SourceChoice& choice);
  void onStatus(const live::RunStatus& status);
  void showRefusal(const std::vector<tracking::SideStatus>& sides);
  void notePause(const live::RunStatus& status);
  void onRecording(bool recording, const live::RunStatus& status);
  void listRecordedEvents();
  void showHelp();
  /// Shows the errors of a recording instead of the plots.
  void analyse(const QString& recording);
  void restore();

  std::unique_ptr<QSettings> settings_;
  Theme theme_ = Theme::dark();
  SourceChoice choice_;
  JointHistory history_;
  SessionLink link_;
  double now_ = 0.0;  ///< newest session time [s]
  QString title_ = "no source";
  tracking::SideWatch sides_;  ///< changes of a live source, for the notes
  struct Refusal {
    std::uint64_t count = 0;  ///< of the side, when it was shown or settled
    std::string shown;        ///< reason; empty: none, or settled
  };
  std::map<std::string, Refusal> refusals_;  ///< by side of a live source
  live::PauseWatch pauses_;                  ///< of a live source, for the notes
  std::optional<double> recording_since_;
  JointFigure* figure_;
  MessageBar *messages_, *news_, *export_news_, *compare_news_, *registration_news_;
  QSplitter* plots_;
  CompareController* compare_;
  SettingsUndo* undo_;
  SessionBar* bar_;
  StereoView* video_;
  SceneView* scene_;
  OcclusionPanel* occlusion_;
  OcclusionController* occlusion_controller_;
  IdentificationPanel* identification_;
  AnalysisPages* analysis_;
  DiagnosisPanel* diagnosis_;
  LearningPanel* learning_;
  QStackedWidget* centre_;
  RegistrationPanel* registration_;
  ReplayBar* replay_;
  ErrorsPanel* errors_;
  NotesPanel* notes_;
  StatusLine* status_;
  MonitorController* monitor_;
  ExportController* export_;
  LayoutController* layouts_;
  QDockWidget* registration_dock_ = nullptr;
  bool laid_out_ = false;
  HelpWindow* help_ = nullptr;
};

}  // namespace capstan::widgets
