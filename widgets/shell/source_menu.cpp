#include "widgets/shell/source_menu.h"

#include <QFileDialog>
#include <QFileInfo>

#include "core/recording/recording_kinds.h"
#include "widgets/shell/live_dialog.h"
#include "widgets/shell/recent_menu.h"
#include "widgets/shell/simulation_dialog.h"

namespace capstan::widgets {

SourceMenu::SourceMenu(QWidget* parent)
    : QMenu(parent), dialog_(new SimulationDialog(parent)), live_(new LiveDialog(parent)) {
  auto* simulate = addAction(tr("New simulated session…"));
  simulate->setObjectName("simulate");
  simulate->setShortcut(QKeySequence::New);
  connect(simulate, &QAction::triggered, dialog_, [this] {
    dialog_->show();
    dialog_->raise();
  });
  auto* open = addAction(tr("Open recording or table…"));
  open->setObjectName("open");
  open->setShortcut(QKeySequence::Open);
  connect(open, &QAction::triggered, this, &SourceMenu::askFile);
  auto* live = addAction(tr("Connect to a live robot…"));
  live->setObjectName("live");
  live->setShortcut(QKeySequence(QStringLiteral("Ctrl+Shift+R")));
  connect(live, &QAction::triggered, live_, [this] {
    live_->show();
    live_->raise();
  });
  connect(live_, &LiveDialog::chosen, this,
          [this](const QString& chosen_live) { Q_EMIT chosen(SourceChoice::ofLive(chosen_live)); });
  auto* recover = addAction(tr("Recover a damaged session…"));
  recover->setObjectName("recover");
  connect(recover, &QAction::triggered, this, &SourceMenu::recoverRequested);
  recent_ = new RecentMenu(this);
  addMenu(recent_);
  connect(recent_, &RecentMenu::chosen, this,
          [this](const QString& file) { Q_EMIT chosen(SourceChoice::ofFile(file)); });
  connect(dialog_, &SimulationDialog::chosen, this, [this](const simulation::SimulationRequest& request) {
    Q_EMIT chosen(SourceChoice::ofSimulation(request));
  });
}

void SourceMenu::askFile() {
  const QStringList files = recent_->files();
  const QString folder = files.isEmpty() ? QString() : QFileInfo(files.front()).absolutePath();
  auto* dialog = new QFileDialog(
      parentWidget(), tr("Open a recording"), folder,
      tr("Recordings (%1);;All files (*)").arg(QString::fromStdString(recording::recordingPatterns())));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  connect(dialog, &QFileDialog::fileSelected, this,
          [this](const QString& file) { Q_EMIT chosen(SourceChoice::ofFile(file)); });
  dialog->open();
}

void SourceMenu::remember(const SourceChoice& choice) {
  if (choice.simulated) {
    dialog_->setRequest(choice.simulation);
    return;
  }
  if (!choice.live.isEmpty()) live_->showLive(choice.live);
  if (!choice.isRecording()) return;
  recent_->remember(choice.file);
}

}  // namespace capstan::widgets
