#pragma once

#include <QWidget>
#include <array>

#include "core/registration/registration_guide.h"
#include "widgets/figures/theme.h"

class QCheckBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace capstan::widgets {

class DriveBar;

/// Step 1: the arm moves to its hard stop; shows each joint's distance from it, and the time at rest.
class StopPage : public QWidget {
  Q_OBJECT

 public:
  explicit StopPage(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// Sets whether the source can be commanded. If so there is a button; otherwise the user moves the arm by
  /// hand and may confirm that it is at the hard stop.
  void setDrivable(bool drivable);
  /// Sets whether commands can be sent to the real robot of the session: then there is a bar for them.
  void setCommandable(bool commandable);
  DriveBar& driveBar() { return *commands_; }
  /// Sets whether the session has ended, so that nothing moves and no more frames arrive.
  void setEnded(bool ended);
  void showGuide(const registration::RegistrationGuide& guide);

 signals:
  void driveRequested();
  void overrideChanged(bool on);
  void collectRequested();

 private:
  Theme theme_ = Theme::dark();
  QLabel* advice_;
  std::array<std::array<QLabel*, 4>, 3> cells_{};  // name, position, distance, verdict
  QProgressBar* rest_;
  QLabel* state_;
  QPushButton* drive_;
  QCheckBox* override_;
  DriveBar* commands_;
  QPushButton* collect_;
  bool drivable_ = false, ended_ = false;
};

}  // namespace capstan::widgets
