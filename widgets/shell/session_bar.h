#pragma once

#include <QToolBar>
#include <functional>

#include "core/live/runner.h"
#include "widgets/shell/source_choice.h"

class QComboBox;

namespace capstan::widgets {

class SourceMenu;

/// Tool bar with all actions on a session: run, step, speed, source, record, registration, identification,
/// analysis, diagnosis, export, note, help, theme. It has no state of its own: showStatus() updates it.
class SessionBar : public QToolBar {
  Q_OBJECT

 public:
  explicit SessionBar(QWidget* parent);

  void showStatus(const live::RunStatus& status);
  void setRecordingFolder(const QString& folder);
  /// Sets the folder that a user chose; refused if recordings cannot be written there.
  void chooseRecordingFolder(const QString& folder);
  QString recordingFolder() const { return folder_; }
  double speed() const;
  void setSpeed(double speed);
  SourceMenu& sources() { return *sources_; }
  /// Adds the action of a panel to the bar, after those added before.
  void addPanelAction(QAction* action);

 signals:
  void runToggled();
  void stepRequested();
  void speedChanged(double speed);
  void recordToggled();
  void recordingFolderChanged(const QString& folder);
  void recordingFolderRefused(const QString& why);
  void exportRequested();
  void exportEverythingRequested();
  void noteRequested();
  void helpRequested();
  void themeToggled();

 private:
  void changeEvent(QEvent* event) override;
  void drawMore();
  QAction* add(const QString& name, const QString& text, const QKeySequence& key, const QString& tip);
  QAction* addOffBar(const QString& name, const QString& text, const QKeySequence& key,
                     std::function<void()> act);
  void showAsSign(QAction& action, const QString& sign);
  void addSpeed();
  void addSources();
  void addRecording();
  void addExport();
  void addGap();
  void askFolder();
  void shiftSpeed(int by);

  QString folder_;
  SourceMenu* sources_ = nullptr;
  QComboBox* speed_ = nullptr;
  std::array<QAction*, 2> shifts_{};  ///< slower, faster
  QAction *run_ = nullptr, *step_ = nullptr, *record_ = nullptr, *export_ = nullptr;
};

}  // namespace capstan::widgets
