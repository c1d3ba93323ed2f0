#include "widgets/shell/settings_watch.h"

#include <utility>

#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/settings_undo.h"

namespace capstan::widgets {

SettingsWatch::SettingsWatch(MainWindow& window, OcclusionPanel& occlusion, SettingsUndo& undo)
    : QObject(&window),
      window_(window),
      occlusion_(occlusion),
      undo_(undo),
      theme_(window.themeName()),
      folder_(window.bar().recordingFolder()),
      speed_(window.bar().speed()),
      schedule_(occlusion.schedule()) {
  connect(&window, &MainWindow::themeChanged, this, &SettingsWatch::onTheme);
  connect(&window.bar(), &SessionBar::speedChanged, this, &SettingsWatch::onSpeed);
  connect(&window.bar(), &SessionBar::recordingFolderChanged, this, &SettingsWatch::onFolder);
  connect(&occlusion, &OcclusionPanel::scheduleChanged, this, &SettingsWatch::onSchedule);
  connect(&window.link(), &SessionLink::opened, this, [this] {
    if (!window_.link().again()) undo_.clear();
    schedule_ = occlusion_.schedule();
  });
}

void SettingsWatch::onTheme() {
  const QString now = window_.themeName(), before = std::exchange(theme_, now);
  if (now == before) return;
  undo_.changed(
      tr("theme %1").arg(now), [this, before] { window_.setThemeNamed(before); },
      [this, now] { window_.setThemeNamed(now); });
}

void SettingsWatch::onSpeed(double speed) {
  const double before = std::exchange(speed_, speed);
  undo_.changed(
      tr("speed"), [this, before] { window_.bar().setSpeed(before); },
      [this, speed] { window_.bar().setSpeed(speed); });
}

void SettingsWatch::onFolder(const QString& folder) {
  const QString before = std::exchange(folder_, folder);
  if (folder == before) return;
  undo_.changed(
      tr("recording folder"), [this, before] { window_.bar().setRecordingFolder(before); },
      [this, folder] { window_.bar().setRecordingFolder(folder); });
}

void SettingsWatch::onSchedule(const live::OcclusionSchedule& schedule) {
  const live::OcclusionSchedule before = std::exchange(schedule_, schedule);
  undo_.changed(
      tr("occlusion schedule"), [this, before] { setSchedule(before); },
      [this, schedule] { setSchedule(schedule); });
}

/// As the user would set it: the session follows, and the notes report it.
void SettingsWatch::setSchedule(const live::OcclusionSchedule& schedule) {
  occlusion_.setSchedule(schedule);
  Q_EMIT occlusion_.scheduleChanged(schedule);
}

}  // namespace capstan::widgets
