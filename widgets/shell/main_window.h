#pragma once

#include <QMainWindow>
#include <QSettings>
#include <optional>

#include "widgets/figures/joint_figure.h"
#include "widgets/shell/session_link.h"

class QAction;
class QComboBox;
class QDockWidget;

namespace capstan::widgets {

class ErrorsPanel;
class MessageBar;
class OcclusionPanel;
class RegistrationPanel;
class SceneView;
class StatusLine;
class StereoView;

/// The workstation's window: pictures and scene left, joint plots in the middle, occlusion and errors right,
/// status below. `settings` (an .ini path) keeps layout, theme and last source; empty: the user's own.
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
  QString message() const;
  QAction* action(const QString& name) const { return findChild<QAction*>(name); }

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  void addDocks();
  void addToolBar();
  QAction* addAct(class QToolBar* bar, const QString& name, const QString& text, const QKeySequence& key,
                  const QString& tip);
  void addSourceMenu(QToolBar* bar);
  void connectLink();
  void connectPanels();
  void onOpened(const session::SourceInfo& info);
  void onStatus(const session::RunStatus& status);
  void retitle(const session::RunStatus& status);
  void restore();

  std::unique_ptr<QSettings> settings_;
  Theme theme_ = Theme::dark();
  SourceChoice choice_;
  JointHistory history_;
  SessionLink link_;
  tracking::Snapshot snapshot_;
  QString title_ = "no source";
  std::optional<double> recording_since_;
  JointFigure* figure_;
  MessageBar* messages_;
  StereoView* video_;
  SceneView* scene_;
  OcclusionPanel* occlusion_;
  RegistrationPanel* registration_;
  ErrorsPanel* errors_;
  StatusLine* status_;
  QDockWidget* registration_dock_ = nullptr;
  QAction *run_ = nullptr, *record_ = nullptr;
  QComboBox* speed_ = nullptr;
};

}  // namespace capstan::widgets
