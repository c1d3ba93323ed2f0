#pragma once

#include <QWidget>

#include "core/live/robot_commands.h"
#include "widgets/figures/theme.h"

class QCheckBox;
class QLabel;
class QPushButton;

namespace capstan::widgets {

/// Controls of commands to a real robot: arm, hold to drive, stop. Nothing here sends anything.
class DriveBar : public QWidget {
  Q_OBJECT

 public:
  explicit DriveBar(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showStatus(const live::CommandStatus& status);

 signals:
  void armRequested();
  void disarmRequested();
  /// The dead-man's button went down, or up.
  void holdChanged(bool down);
  void stopRequested();

 private:
  void refresh();

  Theme theme_ = Theme::dark();
  live::CommandStatus status_;
  QLabel *warning_, *state_;
  QCheckBox* clear_;
  QPushButton *arm_, *hold_, *stop_;
};

/// The state in words, as "commands armed", for the status line and the panel.
QString driveText(const live::CommandStatus& status);

}  // namespace capstan::widgets
