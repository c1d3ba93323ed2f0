#include "widgets/shell/registration_controller.h"

#include <QAction>
#include <QDateTime>
#include <QDockWidget>
#include <utility>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/simulation/camera_mounting.h"
#include "core/simulation/simulated_source.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/registration/camera_strip.h"
#include "widgets/panels/registration/history_page.h"
#include "widgets/panels/registration/poses_page.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/scene/scene_view.h"
#include "widgets/shell/keyboard_reach.h"
#include "widgets/shell/message_bar.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"
#include "widgets/shell/settings_undo.h"

namespace capstan::widgets {

namespace {

constexpr double kBetter = 0.9;  ///< ratio of RMS distances at which another registration is offered

}  // namespace

RegistrationController::RegistrationController(const Views& views, SessionLink& link, SessionBar& bar,
                                               QObject* parent)
    : QObject(parent), views_(views), link_(link) {
  addAction(bar);
  connectPanel();
  connect(&link, &SessionLink::opened, this, &RegistrationController::onOpened);
  watchCameras();
  connect(&link, &SessionLink::robotChanged, this, &RegistrationController::followRobot);
  connect(&link, &SessionLink::status, this, [this](const live::RunStatus& status) {
    views_.panel.setEnded(status.state == live::RunState::kEnded || status.state == live::RunState::kFailed);
  });
  connect(&link, &SessionLink::snapshot, this,
          [this](const tracking::Snapshot& snapshot) { now_ = snapshot.t; });
  connect(&link, &SessionLink::history, this, [this](const std::vector<tracking::Snapshot>& snapshots) {
    for (const auto& snapshot : snapshots)
      if (views_.panel.active()) views_.panel.showSnapshot(snapshot);
  });
  connect(&link, &SessionLink::frames, this,
          [this](const tracking::StereoFrame& frame, const tracking::Snapshot& seen) {
            if (views_.panel.active()) views_.panel.showFrames(frame.left, frame.right, seen);
          });
}

void RegistrationController::onOpened(const tracking::SourceInfo& info, const SourceChoice& choice) {
  if (!link_.again()) accepted_.reset();
  const auto images = link_.again() ? images_ : vision::ImageCorrection{};
  const double scale = link_.again() ? scale_ : 1.0;
  const bool corrected = !images.none() || scale != 1.0;
  images_ = {}, scale_ = 1.0;
  choice_ = choice;
  views_.panel.leave();  // what it collects is of the session before
  // After the scene and the notes have begun the session themselves.
  QMetaObject::invokeMethod(
      this,
      [this, images, scale, corrected] {
        useCameras(images, scale);
        if (corrected && views_.dock.isVisible()) begin();
      },
      Qt::QueuedConnection);
  in_use_ = accepted_ ? accepted_ : info.base_from_camera;
  views_.panel.historyPage().setCurrent(in_use_);
  views_.panel.historyPage().setRobot(info.robot);
  of_poses_ = of_poses_ && accepted_;
  now_ = info.begin;
  if (accepted_) keepAccepted();
  if (views_.dock.isVisible() && !corrected) begin();
}

void RegistrationController::addAction(SessionBar& bar) {
  auto* action = views_.dock.toggleViewAction();
  action->setObjectName("register");
  action->setText(tr("Register"));
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+R")));
  action->setToolTip(tr("Find the cameras' pose at the hard stop (Ctrl+R)"));
  bar.addPanelAction(action);
  connect(action, &QAction::triggered, this, [this](bool shown) {
    if (shown && link_.runner() && !views_.panel.active()) begin();
    if (!shown) return;
    readHistory();
    views_.dock.activateWindow();
    focusFirst(views_.panel);
  });
}

void RegistrationController::connectPanel() {
  using simulation::SimulatedSource;
  connect(&views_.panel, &RegistrationPanel::driveToHardStopRequested, this, [this] {
    command(&SimulatedSource::driveToHardStop);
    link_.setRunning(true);
  });
  connect(&views_.panel.posesPage(), &PosesPage::accepted, this, [this] { of_poses_ = true; });
  connect(&views_.panel.posesPage(), &PosesPage::cleared, this, [this] {
    if (!link_.runner()) return;
    views_.panel.posesPage().begin(link_.runner()->robot(), in_use_);
    notePoses();
  });
  connect(&views_.panel, &RegistrationPanel::accepted, this,
          [this](const Eigen::Isometry3d& base_from_camera) {
            of_poses_ = false;  // unless the poses' page says so next
            use(base_from_camera, tr("accepted"));
            command(&SimulatedSource::resume);
          });
  connect(&views_.panel, &RegistrationPanel::rejected, this, [this](const QString& reason) {
    command(&SimulatedSource::resume);
    views_.notes.addEvent(now_, "registration", tr("rejected: %1").arg(reason));
  });
  connect(&views_.panel, &RegistrationPanel::decided, this, &RegistrationController::addToHistory);
  connect(&views_.panel.historyPage(), &HistoryPage::useRequested, this, &RegistrationController::useAgain);
  connect(&views_.panel, &RegistrationPanel::finished, this, [this] {
    command(&SimulatedSource::resume);
    views_.dock.hide();
  });
}

void RegistrationController::use(const Eigen::Isometry3d& base_from_camera, const QString& how) {
  if (link_.runner()) link_.runner()->setRegistration(base_from_camera);
  const bool other = !in_use_ || !in_use_->isApprox(base_from_camera);
  in_use_ = accepted_ = base_from_camera;
  views_.panel.setInUse(base_from_camera);
  views_.scene.setRegistration(base_from_camera);
  views_.notes.addEvent(now_, "registration", how + (other ? tr(", errors restarted") : QString()));
}

/// The cameras are checked while the dock is visible.
void RegistrationController::watchCameras() {
  CameraStrip& strip = views_.panel.cameras();
  connect(&link_, &SessionLink::frames, this,
          [this, &strip](const tracking::StereoFrame& frame, const tracking::Snapshot& seen) {
            if (!views_.dock.isVisible()) return;
            strip.setMarker(link_.runner()->marker());
            strip.see(frame, seen);
          });
  connect(&link_, &SessionLink::history, this,
          [this, &strip](const std::vector<tracking::Snapshot>& snapshots) {
            if (views_.dock.isVisible())
              for (const auto& snapshot : snapshots) strip.observe(snapshot);
          });
  connect(&link_, &SessionLink::status, this, [this, &strip](const live::RunStatus& status) {
    if (views_.dock.isVisible()) strip.setNow(status.t, status.sides);
  });
  connect(&views_.panel, &RegistrationPanel::remedyRequested, this, &RegistrationController::correct);
}

void RegistrationController::correct(const registration::CameraRemedy& remedy) {
  if (!link_.runner()) return;
  const auto images = std::pair{images_, images_.then(remedy.correction)};
  const auto scale = std::pair{scale_, scale_ * remedy.scale};
  const auto apply = [this](const vision::ImageCorrection& to, double by) {
    useCameras(to, by);
    begin();
  };
  apply(images.second, scale.second);
  views_.undo.changed(
      tr("correction of the cameras"), [apply, images, scale] { apply(images.first, scale.first); },
      [apply, images, scale] { apply(images.second, scale.second); });
}

/// Corrects the images of the source and the base line of its cameras from now on.
void RegistrationController::useCameras(const vision::ImageCorrection& images, double scale) {
  if (!link_.runner()) return;
  if (images != images_) {
    link_.runner()->setImages(images);
    views_.notes.addEvent(now_, "cameras",
                          images.none() ? tr("images as they come") : QString::fromStdString(images.words()));
  }
  const auto& source = link_.runner()->info();
  if (scale != scale_ && source.rig) {
    const auto rig = registration::scaledBaseline(*source.rig, scale);
    const QString words = tr("base line %1 mm").arg(base::toMillimetres(rig.baseline()), 0, 'f', 2);
    link_.runner()->setRig(rig, words.toStdString());
    views_.scene.setRobot(link_.runner()->robot(), rig, in_use_);
    views_.notes.addEvent(now_, "cameras", words);
  }
  images_ = images;
  scale_ = scale;
}

void RegistrationController::addToHistory(registration::HistoryEntry entry) {
  entry.date = QDateTime::currentDateTime().toString(Qt::ISODate).toStdString();
  if (link_.runner()) {
    entry.robot = link_.runner()->robot().name;
    entry.session = link_.runner()->info().title;
  }
  HistoryPage& page = views_.panel.historyPage();
  try {
    page.setEntries(registration::addToHistory(views_.history, entry));
    page.showFault({});
  } catch (const base::InputError& error) {
    page.showFault(QString::fromUtf8(error.what()));
    views_.news.showMessage(
        tr("The registration was not added to the history: %1").arg(QString::fromUtf8(error.what())));
  }
}

void RegistrationController::readHistory() {
  HistoryPage& page = views_.panel.historyPage();
  try {
    page.setEntries(registration::readHistory(views_.history));
    page.showFault({});
  } catch (const base::InputError& error) {
    page.setEntries({});
    page.showFault(QString::fromUtf8(error.what()));
  }
}

/// Puts a registration of the history or of a file in use.
void RegistrationController::useAgain(const registration::HistoryEntry& entry) {
  of_poses_ = false;
  use(*entry.pose(), tr("%1 %2").arg(QString::fromUtf8(base::nameOf(entry.decision).data()),
                                     QString::fromStdString(entry.reason)));
  addToHistory(entry);
  if (!views_.panel.active()) begin();
}

/// Poses are tips by the robot's constants: with other constants, the registration that was fitted to them is
/// wrong by what those were wrong.
void RegistrationController::followRobot() {
  if (!link_.runner()) return;
  views_.panel.posesPage().setRobot(link_.runner()->robot());
  const registration::PoseCollector* collector = views_.panel.posesPage().collector();
  if (!of_poses_ || !in_use_ || !collector || !collector->fit()) return;
  const auto& fit = *collector->fit();
  const double before = base::toMillimetres(collector->rmsBy(*in_use_)), after = base::toMillimetres(fit.rms);
  if (after > kBetter * before) return;
  views_.news.showNews(tr("The cameras were registered with the robot's former constants. With the new ones "
                          "the same poses fit to "
                          "%1 mm instead of %2 mm.")
                           .arg(after, 0, 'f', 2)
                           .arg(before, 0, 'f', 2),
                       {{tr("Register again"), [this, fit] {
                           auto entry = registration::entryOf(registration::Decision::kAccepted, fit);
                           entry.reason = "fitted again to the same poses, with other constants of the robot";
                           use(fit.base_from_camera, tr("fitted again to the same poses"));
                           addToHistory(entry);
                         }}});
}

/// Passes an accepted registration on, after the scene and the notes have begun the session themselves.
void RegistrationController::keepAccepted() {
  link_.runner()->setRegistration(*accepted_);
  const auto tell = [this] {
    if (!accepted_) return;
    views_.scene.setRegistration(*accepted_);
    views_.notes.addEvent(now_, "registration", tr("the accepted registration stays in use"));
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
  const tracking::SourceInfo info = link_.runner()->infoInUse();  // poses are tips by its robot's constants
  std::optional<Eigen::Isometry3d> nominal;
  if (info.live) nominal = simulation::nominalBaseFromCamera(info.robot);
  views_.panel.begin(info, in_use_, nominal, link_.runner()->marker(), posesTaken());
  if (views_.panel.posesPage().elsewhere()) return;
  notePoses();
}

/// The panel's poses are of the present cameras from now on.
void RegistrationController::notePoses() {
  poses_by_ = camerasNow();
  poses_session_ = QString::fromStdString(link_.runner()->info().title);
}

/// Where the panel's poses were taken, if by other cameras than those of now; else empty.
QString RegistrationController::posesTaken() {
  if (poses_by_ == camerasNow()) return {};
  return poses_by_.choice == choice_ ? tr("before the cameras were corrected")
                                     : tr("in the session %1").arg(poses_session_);
}

}  // namespace capstan::widgets
