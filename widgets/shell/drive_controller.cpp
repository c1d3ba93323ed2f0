#include "widgets/shell/drive_controller.h"

#include <QApplication>
#include <QDockWidget>
#include <QKeyEvent>
#include <QPointer>

#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/drive_bar.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/registration/stop_page.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

using live::DriveState;
using live::DriveStop;

DriveController::DriveController(const Views& views, SessionLink& link, QObject* parent)
    : QObject(parent), views_(views), panel_(&views.panel), link_(link) {
  connectBar();
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo& info) {
    now_ = info.begin;
    askForCommands();
  });
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { now_ = snapshot.t; });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    if (status.state != live::RunState::kRunning) stop(DriveStop::kEnded);
  });
  connect(&views_.dock, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (!visible) stop(DriveStop::kFocus);
  });
  connect(qApp, &QGuiApplication::applicationStateChanged, this, [this](Qt::ApplicationState state) {
    if (state != Qt::ApplicationActive) stop(DriveStop::kFocus);
  });
  connect(qApp, &QGuiApplication::focusWindowChanged, this, [this] {
    if (held_) stop(DriveStop::kFocus);
  });
  renew_.setInterval(kRenew);
  connect(&renew_, &QTimer::timeout, this, &DriveController::renew);
  look_.setInterval(2 * kRenew);
  connect(&look_, &QTimer::timeout, this, &DriveController::showStatus);
  qApp->installEventFilter(this);
}

/// The views may be gone already.
DriveController::~DriveController() {
  qApp->removeEventFilter(this);
  if (commands_) commands_->stop(DriveStop::kEnded);
}

void DriveController::connectBar() {
  DriveBar& bar = views_.panel.stopPage().driveBar();
  connect(&bar, &DriveBar::armRequested, this, [this] {
    if (commands_) commands_->arm();
  });
  connect(&bar, &DriveBar::disarmRequested, this, [this] {
    setHeld(false);
    if (commands_) commands_->disarm();
    showStatus();
  });
  connect(&bar, &DriveBar::holdChanged, this, &DriveController::setHeld);
  connect(&bar, &DriveBar::stopRequested, this, [this] { stop(DriveStop::kByHand); });
}

/// Asks the source on its own thread; the answer comes back to this one.
void DriveController::askForCommands() {
  take(nullptr);
  if (!link_.runner()) return;
  const auto answer = [self =
                           QPointer<DriveController>(this)](std::shared_ptr<live::RobotCommands> commands) {
    QMetaObject::invokeMethod(
        qApp,
        [self, commands = std::move(commands)] {
          if (self) self->take(commands);
        },
        Qt::QueuedConnection);
  };
  link_.runner()->post([answer](tracking::Source& source, tracking::TrackingPipeline&) {
    if (const auto* robot = dynamic_cast<live::Commandable*>(&source)) answer(robot->commands());
  });
}

void DriveController::take(std::shared_ptr<live::RobotCommands> commands) {
  stop(DriveStop::kEnded);
  commands_ = std::move(commands);
  shown_ = {};
  views_.panel.stopPage().setCommandable(commands_ != nullptr);
  views_.status.setCommands({}, false);
  if (!commands_) return look_.stop();
  look_.start();
  showStatus();
}

void DriveController::setHeld(bool held) {
  held_ = held && commands_;
  if (!held_) {
    renew_.stop();
    if (commands_) commands_->release();
  } else {
    commands_->hold();
    renewed_.start();
    renew_.start();
  }
  showStatus();
}

/// After a time in which this program did nothing, the key may have been released: it has to be pressed anew.
void DriveController::renew() {
  if (!commands_ || !held_) return;
  if (renewed_.restart() > 1e3 * live::ArmedDrive::kHold) return setHeld(false);
  commands_->hold();
}

void DriveController::stop(DriveStop cause) {
  held_ = false;
  renew_.stop();
  if (!commands_) return;
  commands_->stop(cause);
  showStatus();
}

bool DriveController::eventFilter(QObject* watched, QEvent* event) {
  const bool press = event->type() == QEvent::KeyPress;
  if (!commands_ || !(press || event->type() == QEvent::KeyRelease))
    return QObject::eventFilter(watched, event);
  const auto* key = static_cast<QKeyEvent*>(event);
  if (key->key() == Qt::Key_F9) {
    if (press) stop(DriveStop::kByHand);
    return true;
  }
  if (key->key() != Qt::Key_F8) return QObject::eventFilter(watched, event);
  // The key repeats while it is held: neither a press nor a release.
  if (!key->isAutoRepeat() && press != held_) setHeld(press);
  return true;
}

/// Shows the state, and notes what has changed.
void DriveController::showStatus() {
  if (!commands_ || !panel_) return;  // the window closes
  const live::CommandStatus status = commands_->status();
  views_.panel.stopPage().driveBar().showStatus(status);
  const bool changed = status.state != shown_.state || status.reason != shown_.reason;
  const bool released = status.state == DriveState::kArmed && shown_.state == DriveState::kMoving;
  shown_ = status;
  if (!changed) return;
  views_.status.setCommands(driveText(status), status.state != DriveState::kDisarmed);
  QString words = driveText(status);
  if (released) words = tr("key released, commands stay armed");
  if (status.state == DriveState::kMoving)
    words = tr("driven to the hard stop by %1").arg(QString::fromStdString(status.topic));
  views_.notes.addEvent(now_, "robot", words);
}

}  // namespace capstan::widgets
