#include "widgets/shell/identification_controller.h"

#include <QAction>
#include <QDockWidget>

#include "core/simulation/simulated_source.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

IdentificationController::IdentificationController(IdentificationPanel& panel, QDockWidget& dock,
                                                   SessionLink& link, SessionBar& bar, NotesPanel& notes,
                                                   QObject* parent)
    : QObject(parent), panel_(panel) {
  auto* action = new QAction(tr("Identify"), this);
  action->setObjectName("identify");
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+I")));
  action->setToolTip(tr("Find wrong parameters of the robot file while the session runs (Ctrl+I)"));
  bar.addPanelAction(action);
  // A dock behind another tab is brought to the front; a dock in front is hidden.
  connect(action, &QAction::triggered, &dock, [&dock] {
    const bool in_front = dock.isVisible() && !dock.visibleRegion().isEmpty();
    dock.setVisible(!in_front);
    if (!in_front) dock.raise();
  });
  connect(&link, &SessionLink::opened, this, [this, &link](const tracking::SourceInfo& info) {
    panel_.begin(info);
    if (const auto* chosen = link.robots().robotFor(info)) panel_.useRobot(*chosen, link.robots().origin());
  });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    now_ = status.t;
    panel_.showStatus(status);
  });
  listen(link);
  chooseRobots(link, notes);
  drive(link, notes);
  connect(&panel, &IdentificationPanel::robotSaved, this,
          [this, &notes](const QString& path) { notes.addFile(now_, "robot", path); });
}

void IdentificationController::listen(SessionLink& link) {
  connect(&panel_, &IdentificationPanel::listenerRequested, this,
          [this, &link](const std::shared_ptr<identification::LiveRecording>& sink) {
            if (!link.runner()) return;
            if (!sink) return link.listen(this, {});
            link.listen(this, {[sink](const tracking::TrackingPipeline& pipeline) { sink->begin(pipeline); },
                               [sink](const tracking::Sample& sample, const tracking::Snapshot& snapshot) {
                                 sink->take(sample, snapshot);
                               }});
          });
}

/// Drives a simulated robot along the proposed motion; it then continues its own.
void IdentificationController::drive(SessionLink& link, NotesPanel& notes) {
  connect(&panel_, &IdentificationPanel::motionRequested, this,
          [this, &link, &notes](const identification::SinusoidMotion& motion, const QString& words) {
            if (!link.runner()) return;
            simulation::TrajectorySpec spec;
            spec.kind = simulation::TrajectoryKind::kSinusoid;
            spec.duration = motion.duration;
            spec.sinusoid = {motion.centre, motion.amplitude, motion.frequency};
            link.runner()->post([spec](tracking::Source& source, tracking::TrackingPipeline&) {
              if (auto* robot = dynamic_cast<simulation::SimulatedSource*>(&source)) robot->drive(spec);
            });
            link.setRunning(true);
            notes.addEvent(now_, "motion", words);
          });
}

void IdentificationController::chooseRobots(SessionLink& link, NotesPanel& notes) {
  connect(&panel_, &IdentificationPanel::robotChosen, this,
          [this, &link, &notes](const robot::Description& robot, const QString& summary) {
            const QString origin = QString::fromStdString(panel_.live().origin());
            if (link.useRobot(robot, {tr("identified"), origin, summary}))
              notes.addEvent(now_, "robot", summary);
          });
}

}  // namespace capstan::widgets
