#include "widgets/shell/diagnosis_controller.h"

#include <QAction>
#include <QStackedWidget>

#include "widgets/panels/diagnosis/diagnosis_panel.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/dock_scroll.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

DiagnosisController::DiagnosisController(DiagnosisPanel& panel, QStackedWidget& centre, SessionLink& link,
                                         SessionBar& bar, IdentificationPanel& identification,
                                         NotesPanel& notes, QObject* parent)
    : QObject(parent), panel_(panel) {
  addAction(centre, bar);
  offerRecordings(link);
  useRobots(link, identification, notes);
  connect(&panel, &DiagnosisPanel::robotSaved, this,
          [this, &notes](const QString& path) { notes.addFile(now_, "robot", path); });
  connect(&panel, &DiagnosisPanel::exported, this,
          [this, &notes](const QString& index) { notes.addFile(now_, "export", index); });
}

void DiagnosisController::addAction(QStackedWidget& centre, SessionBar& bar) {
  auto* action = new QAction(tr("Diagnose"), this);
  action->setObjectName("diagnose");
  action->setCheckable(true);
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+D")));
  action->setToolTip(
      tr("Show where the robot model disagrees with recordings, and why, instead of the plots, or the plots "
         "again (Ctrl+D)"));
  bar.addPanelAction(action);
  connect(action, &QAction::toggled, &centre, [this, &centre](bool shown) {
    centre.setCurrentIndex(shown ? pageWith(centre, panel_) : 0);
    if (shown) panel_.setFocus();
  });
}

void DiagnosisController::offerRecordings(SessionLink& link) {
  connect(&link, &SessionLink::opened, this,
          [this](const tracking::SourceInfo& info, const SourceChoice& choice) {
            now_ = info.begin;
            panel_.setSession({info.robot.size(), QString::fromStdString(info.robot.name),
                               choice.isRecording() ? choice.file : QString()});
            if (!choice.isRecording()) return;
            panel_.offer(choice.file, tr("Choose the open one"), choice.read_as);
            panel_.preselect(choice.file, choice.robot, choice.read_as);
          });
  connect(&link, &SessionLink::status, this, &DiagnosisController::onStatus);
}

/// Offers a recording when its file is complete.
void DiagnosisController::onStatus(const live::RunStatus& status) {
  now_ = status.t;
  const bool recording = status.recorder && status.recorder->state == recording::RecorderState::kRecording;
  const bool failed = status.recorder && status.recorder->state == recording::RecorderState::kFailed;
  if (!recording_.isEmpty() && !recording && !failed)
    panel_.offer(recording_, tr("Choose the one just recorded"));
  recording_ = recording ? QString::fromStdString(status.recording) : QString();
}

void DiagnosisController::useRobots(SessionLink& link, IdentificationPanel& identification,
                                    NotesPanel& notes) {
  connect(&panel_, &DiagnosisPanel::robotChosen, this,
          [this, &link, &identification, &notes](const robot::Description& robot, const QString& summary) {
            const QString origin = tr("diagnosis");
            if (!link.useRobot(robot, {tr("diagnosed"), origin, summary})) return;
            identification.useRobot(robot, origin);
            notes.addEvent(now_, "robot", summary);
          });
}

}  // namespace capstan::widgets
