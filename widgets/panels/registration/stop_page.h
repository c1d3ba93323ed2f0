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

/// Step 1: the arm goes to its hard stop; each joint's distance from it, and how long the arm has been at
/// rest.
class StopPage : public QWidget {
  Q_OBJECT

 public:
  explicit StopPage(QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  /// A source that can be commanded gets a button; others are moved by hand, and their user may vouch for the
  /// place.
  void setDrivable(bool drivable);
  /// Nothing moves and no frame comes any more.
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
  QPushButton* collect_;
  bool drivable_ = false, ended_ = false;
};

}  // namespace capstan::widgets
