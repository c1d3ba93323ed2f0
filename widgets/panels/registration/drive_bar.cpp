#include "widgets/panels/registration/drive_bar.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

namespace capstan::widgets {

using live::DriveState;

QString driveText(const live::CommandStatus& status) {
  const QString reason = QString::fromStdString(status.reason);
  switch (status.state) {
    case DriveState::kDisarmed:
      return reason.isEmpty() ? QObject::tr("commands disarmed")
                              : QObject::tr("commands not armed: %1").arg(reason);
    case DriveState::kArmed:
      return QObject::tr("commands armed");
    case DriveState::kMoving:
      return QObject::tr("THE ROBOT IS DRIVEN");
    case DriveState::kStopped:
      break;
  }
  return QObject::tr("robot stopped: %1").arg(reason);
}

DriveBar::DriveBar(QWidget* parent) : QWidget(parent) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 6, 0, 0);
  warning_ =
      new QLabel(tr("<b>This moves the real robot.</b> The stop here is no emergency stop: it depends on "
                    "this computer and the "
                    "network. Keep the robot's own emergency stop in your hand."));
  warning_->setWordWrap(true);
  clear_ = new QCheckBox(tr("Nobody is within reach of the arm, and its way to the hard stop is free"));
  arm_ = new QPushButton(tr("Arm commands"));
  hold_ = new QPushButton(tr("Hold to drive to the hard stop (F8)"));
  stop_ = new QPushButton(tr("STOP (F9)"));
  hold_->setObjectName("drive_hold"), stop_->setObjectName("drive_stop"), arm_->setObjectName("drive_arm");
  clear_->setObjectName("drive_clear");
  hold_->setAutoRepeat(false);
  state_ = new QLabel;
  state_->setObjectName("drive_state");
  state_->setWordWrap(true);
  state_->setFont(textFont(10.5, true));
  grid->addWidget(warning_, 0, 0, 1, 3);
  grid->addWidget(clear_, 1, 0, 1, 3);
  grid->addWidget(arm_, 2, 0);
  grid->addWidget(hold_, 2, 1);
  grid->addWidget(stop_, 2, 2);
  grid->addWidget(state_, 3, 0, 1, 3);
  grid->setColumnStretch(1, 1);
  connect(clear_, &QCheckBox::toggled, this, [this](bool on) {
    if (!on) Q_EMIT disarmRequested();
    refresh();
  });
  connect(arm_, &QPushButton::clicked, this, [this] {
    const bool armed = status_.state == DriveState::kArmed || status_.state == DriveState::kMoving;
    armed ? Q_EMIT disarmRequested() : Q_EMIT armRequested();
  });
  connect(hold_, &QPushButton::pressed, this, [this] { Q_EMIT holdChanged(true); });
  connect(hold_, &QPushButton::released, this, [this] { Q_EMIT holdChanged(false); });
  connect(stop_, &QPushButton::pressed, this, &DriveBar::stopRequested);
  refresh();
}

void DriveBar::setTheme(const Theme& theme) {
  theme_ = theme;
  stop_->setStyleSheet(
      QStringLiteral("QPushButton { background:%1; color:white; font-weight:bold; padding:6px 18px; }")
          .arg(QStringLiteral("#b3261e")));
  refresh();
}

void DriveBar::showStatus(const live::CommandStatus& status) {
  status_ = status;
  refresh();
}

void DriveBar::refresh() {
  const bool armed = status_.state == DriveState::kArmed || status_.state == DriveState::kMoving;
  arm_->setText(armed ? tr("Disarm") : tr("Arm commands"));
  arm_->setEnabled(armed || clear_->isChecked());
  arm_->setToolTip(tr("Commands go to %1, while they are armed and F8 is held")
                       .arg(QString::fromStdString(status_.topic)));
  hold_->setEnabled(armed);
  state_->setText(driveText(status_));
  const bool loud = status_.state == DriveState::kMoving || status_.state == DriveState::kStopped;
  const QColor colour = loud ? theme_.fault : armed ? theme_.warning : theme_.muted;
  restyle(*state_, QStringLiteral("color:%1;").arg(theme_.inkOf(colour).name()));
}

}  // namespace capstan::widgets
