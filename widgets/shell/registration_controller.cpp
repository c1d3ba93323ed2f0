#include "widgets/shell/registration_controller.h"

#include <QAction>
#include <QDockWidget>

#include "core/simulation/camera_mounting.h"
#include "core/simulation/simulated_source.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/keyboard_reach.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

RegistrationController::RegistrationController(RegistrationPanel& panel, QDockWidget& dock, SessionLink& link,
                                               SessionBar& bar, SceneView& scene, NotesPanel& notes,
                                               QObject* parent)
    : QObject(parent), panel_(panel), dock_(dock), link_(link) {
  addAction(bar);
  connectPanel(scene, notes);
  connect(&link, &SessionLink::opened, this, [this, &scene, &notes](const tracking::SourceInfo& info) {
    if (!link_.again()) accepted_.reset();
    in_use_ = accepted_ ? accepted_ : info.base_from_camera;
    now_ = info.begin;
    if (accepted_) keepAccepted(scene, notes);
    if (dock_.isVisible()) begin();
  });
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    panel_.setEnded(status.state == live::RunState::kEnded || status.state == live::RunState::kFailed);
  });
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { now_ = snapshot.t; });
  connect(&link, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const auto& snapshot : snapshots)
      if (panel_.active()) panel_.showSnapshot(snapshot);
  });
  connect(&link, &SessionLink::frames, this,
          [this](const tracking::StereoFrame& frame, const tracking::Snapshot& seen) {
            if (panel_.active()) panel_.showFrames(frame.left, frame.right, seen);
          });
}

void RegistrationController::addAction(SessionBar& bar) {
  auto* action = dock_.toggleViewAction();
  action->setObjectName("register");
  action->setText(tr("Register"));
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+R")));
  action->setToolTip(tr("Find the cameras' pose at the hard stop (Ctrl+R)"));
  bar.addPanelAction(action);
  connect(action, &QAction::triggered, this, [this](bool shown) {
    if (shown && link_.runner() && !panel_.active()) begin();
    if (!shown) return;
    dock_.activateWindow();
    focusFirst(panel_);
  });
}

void RegistrationController::connectPanel(SceneView& scene, NotesPanel& notes) {
  using simulation::SimulatedSource;
  connect(&panel_, &RegistrationPanel::driveToHardStopRequested, this, [this] {
    command(&SimulatedSource::driveToHardStop);
    link_.setRunning(true);
  });
  connect(&panel_, &RegistrationPanel::accepted, this,
          [this, &scene, &notes](const Eigen::Isometry3d& base_from_camera) {
            if (link_.runner()) link_.runner()->setRegistration(base_from_camera);
            in_use_ = accepted_ = base_from_camera;
            scene.setRegistration(base_from_camera);
            command(&SimulatedSource::resume);
            notes.addEvent(now_, "registration", tr("accepted"));
          });
  connect(&panel_, &RegistrationPanel::rejected, this, [this, &notes](const QString& reason) {
    command(&SimulatedSource::resume);
    notes.addEvent(now_, "registration", tr("rejected: %1").arg(reason));
  });
  connect(&panel_, &RegistrationPanel::finished, this, [this] {
    command(&SimulatedSource::resume);
    dock_.hide();
  });
}

/// Passes an accepted registration on, after the scene and the notes have begun the session themselves.
void RegistrationController::keepAccepted(SceneView& scene, NotesPanel& notes) {
  link_.runner()->setRegistration(*accepted_);
  const auto tell = [this, &scene, &notes] {
    if (!accepted_) return;
    scene.setRegistration(*accepted_);
    notes.addEvent(now_, "registration", tr("the accepted registration stays in use"));
  };
  QMetaObject::invokeMethod(this, tell, Qt::QueuedConnection);
}

void RegistrationController::command(void (simulation::SimulatedSource::*what)()) {
  if (!link_.runner()) return;
  link_.runner()->post([what](tracking::Source& source, tracking::TrackingPipeline&) {
    if (auto* simulated = dynamic_cast<simulation::SimulatedSource*>(&source)) (simulated->*what)();
  });
}

void RegistrationController::begin() {
  const auto& info = link_.runner()->info();
  auto current = in_use_;
  if (!current && info.live) current = simulation::nominalBaseFromCamera(info.robot);
  panel_.begin(info, current);
}

}  // namespace capstan::widgets
