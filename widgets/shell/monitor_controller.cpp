#include "widgets/shell/monitor_controller.h"

#include <QAction>
#include <QCoreApplication>
#include <QFileInfo>
#include <QProcess>
#include <QStandardPaths>

#include "core/base/error.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

namespace {

constexpr const char* kMonitor = "capstan-monitor";

/// Beside this program, beside it in the folder of a build, or on the path; empty: nowhere.
QString monitorProgram() {
  const QString here = QCoreApplication::applicationDirPath();
  const QString found = QStandardPaths::findExecutable(kMonitor, {here, here + "/../monitor"});
  return found.isEmpty() ? QStandardPaths::findExecutable(kMonitor) : found;
}

}  // namespace

MonitorController::MonitorController(SessionLink& link, SessionBar& bar, MessageBar& messages,
                                     NotesPanel& notes, QObject* parent)
    : QObject(parent), link_(link), messages_(messages), notes_(notes), program_(monitorProgram()) {
  auto* action = new QAction(tr("Monitor"), this);
  action->setObjectName("monitor");
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+M")));
  action->setToolTip(tr("Stereo monitor: both cameras with the arm where the filter has it (Ctrl+M)"));
  bar.addPanelAction(action);
  connect(action, &QAction::triggered, this, &MonitorController::startMonitor);
  connect(&link, &SessionLink::opened, this, [this](const tracking::SourceInfo& info) {
    now_ = info.begin;
    if (feed_) listen();
  });
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { now_ = snapshot.t; });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    if (feed_) feed_->setState(status.state);
  });
}

QString MonitorController::feed() const { return feed_ ? QString::fromStdString(feed_->name()) : QString(); }

void MonitorController::startFeed(const QString& name) {
  if (feed_) return;
  feed_ = name.isEmpty() ? live::makeMonitorFeed() : std::make_unique<live::MonitorFeed>(name.toStdString());
  if (link_.runner()) listen();
}

void MonitorController::listen() { link_.listen(this, feed_->begin(link_.runner()->info())); }

void MonitorController::startMonitor() {
  try {
    startFeed({});
  } catch (const base::InputError& error) {
    return messages_.showMessage(QString::fromStdString(error.what()));
  }
  if (program_.isEmpty() || !QProcess::startDetached(program_, {"--feed", feed()}))
    return messages_.showMessage(tr("%1 was not found beside %2. Start it by hand: capstan-monitor --feed %3")
                                     .arg(kMonitor, QCoreApplication::applicationFilePath(), feed()));
  notes_.addEvent(now_, "monitor", tr("started, feed %1").arg(feed()));
}

}  // namespace capstan::widgets
