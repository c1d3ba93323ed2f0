#pragma once

#include <QObject>

#include "core/live/occlusion.h"

namespace capstan::widgets {

class MainWindow;
class OcclusionPanel;
class SettingsUndo;

/// Reports changes of the window's settings to SettingsUndo: theme, speed, recording folder and schedule of
/// occlusion. The changes of a session end with it.
class SettingsWatch : public QObject {
  Q_OBJECT

 public:
  SettingsWatch(MainWindow& window, OcclusionPanel& occlusion, SettingsUndo& undo);

 private:
  void onTheme();
  void onSpeed(double speed);
  void onFolder(const QString& folder);
  void onSchedule(const live::OcclusionSchedule& schedule);
  void setSchedule(const live::OcclusionSchedule& schedule);

  MainWindow& window_;
  OcclusionPanel& occlusion_;
  SettingsUndo& undo_;
  QString theme_, folder_;  ///< values before the next change
  double speed_;
  live::OcclusionSchedule schedule_;
};

}  // namespace capstan::widgets
