#include "widgets/shell/motor_controller.h"

#include <QAction>
#include <QMenu>
#include <QToolButton>

#include "widgets/figures/joint_figure.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

using tracking::MotorFault;

MotorController::MotorController(JointFigure& figure, SessionLink& link, SessionBar& bar,
                                 MessageBar& messages, NotesPanel& notes, QObject* parent)
    : QObject(parent), figure_(figure), messages_(messages), notes_(notes) {
  addMenu(bar, link);
  connect(&link, &SessionLink::opened, this, [this, &link](const tracking::SourceInfo& info) {
    now_ = info.begin;
    keepDeclared(link);
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      joints_[i] = i < info.robot.joints.size() ? QString::fromStdString(info.robot.joints[i].name)
                                                : tr("joint %1").arg(i + 1);
      failed_[i]->setText(tr("Motor %1 (%2) has failed").arg(i + 1).arg(joints_[i]));
      failed_[i]->setChecked(false);
      failed_[i]->setEnabled(true);
    }
    faults_ = {};
    figure_.setRemarks({});
  });
  connect(&link, &SessionLink::snapshot, this, &MotorController::showFaults);
}

void MotorController::addMenu(SessionBar& bar, SessionLink& link) {
  auto* action = new QAction(tr("Motors"), this);
  action->setObjectName("motors");
  action->setToolTip(tr("Mark a motor's encoder as failed, or as usable again"));
  auto* menu = new QMenu(&bar);
  menu->setToolTipsVisible(true);
  action->setMenu(menu);
  for (int motor = 0; motor < 3; ++motor) {
    QAction* one = menu->addAction(tr("Motor %1 has failed").arg(motor + 1));
    one->setObjectName(QStringLiteral("motor%1failed").arg(motor + 1));
    one->setCheckable(true);
    one->setEnabled(false);
    one->setToolTip(tr("Its joint is then estimated from the cameras alone"));
    connect(one, &QAction::triggered, this, [&link, motor](bool failed) {
      if (!link.runner()) return;
      link.runner()->post([motor, failed](tracking::Source&, tracking::TrackingPipeline& pipeline) {
        pipeline.setMotorFailed(motor, failed);
      });
    });
    failed_[static_cast<std::size_t>(motor)] = one;
  }
  bar.addPanelAction(action);
  if (auto* button = qobject_cast<QToolButton*>(bar.widgetForAction(action)))
    button->setPopupMode(QToolButton::InstantPopup);
}

/// Keeps motors declared as failed by a user, until the user takes it back.
void MotorController::keepDeclared(SessionLink& link) {
  for (std::size_t i = 0; i < faults_.size(); ++i)
    if (link.again() && faults_[i] == MotorFault::kDeclared)
      link.runner()->post(
          [motor = static_cast<int>(i)](tracking::Source&, tracking::TrackingPipeline& pipeline) {
            pipeline.setMotorFailed(motor, true);
          });
}

void MotorController::showFaults(const tracking::Snapshot& snapshot) {
  now_ = snapshot.t;
  if (snapshot.motor_failed == faults_) return;
  std::array<QString, 3> remarks;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const MotorFault fault = snapshot.motor_failed[i];
    failed_[i]->setChecked(fault != MotorFault::kNone);
    if (fault != MotorFault::kNone) remarks[i] = tr("encoder %1").arg(faultWords(fault));
    if (fault != faults_[i]) report(static_cast<int>(i), fault);
  }
  faults_ = snapshot.motor_failed;
  figure_.setRemarks(remarks);
}

void MotorController::report(int motor, MotorFault fault) {
  const QString name =
      tr("encoder of motor %1 (%2)").arg(motor + 1).arg(joints_[static_cast<std::size_t>(motor)]);
  if (fault == MotorFault::kNone) return notes_.addEvent(now_, "motor", tr("%1: in use again").arg(name));
  const QString words =
      tr("%1 %2: q%3 is estimated from the cameras alone").arg(name, faultWords(fault)).arg(motor + 1);
  if (fault == MotorFault::kDeclared) return notes_.addEvent(now_, "motor", words);
  notes_.addEvent(now_, "fault", words);
  messages_.showMessage(words + tr(". Once it is repaired, untick it under Motors"));
}

}  // namespace capstan::widgets
