#pragma once

#include <Eigen/Geometry>
#include <QObject>
#include <filesystem>
#include <optional>

#include "core/registration/camera_checks.h"
#include "core/registration/registration_history.h"
#include "widgets/shell/source_choice.h"

class QDockWidget;

namespace capstan::tracking {
struct SourceInfo;
}
namespace capstan::simulation {
class SimulatedSource;
}

namespace capstan::widgets {

class MessageBar;
class NotesPanel;
class RegistrationPanel;
class SceneView;
class SessionBar;
class SessionLink;
class SettingsUndo;

/// Connects the registration panel to the running session: moves the simulated arm, passes the accepted pose
/// of the cameras to the pipeline and the scene, and adds an entry in the bar and notes. When the robot
/// changes, as by an identification, poses that the registration in use was fitted to are fitted again, and
/// the better registration is offered. Keeps the history of all decisions.
class RegistrationController : public QObject {
  Q_OBJECT

 public:
  struct Views {
    RegistrationPanel& panel;
    QDockWidget& dock;
    SceneView& scene;
    NotesPanel& notes;
    MessageBar& news;
    SettingsUndo& undo;
    std::filesystem::path history;  ///< file of the history of registrations
  };
  RegistrationController(const Views& views, SessionLink& link, SessionBar& bar, QObject* parent);

 private:
  /// What poses of one registration have in common.
  struct CameraUse {
    SourceChoice choice;
    vision::ImageCorrection images;
    double scale = 1.0;
    bool operator==(const CameraUse&) const = default;
  };
  CameraUse camerasNow() const { return {choice_, images_, scale_}; }
  void onOpened(const tracking::SourceInfo& info, const SourceChoice& choice);
  QString posesTaken();
  void notePoses();
  void addAction(SessionBar& bar);
  void connectPanel();
  void command(void (simulation::SimulatedSource::*what)());
  void begin();
  void keepAccepted();
  void use(const Eigen::Isometry3d& base_from_camera, const QString& how);
  void followRobot();
  void watchCameras();
  void correct(const registration::CameraRemedy& remedy);
  void useCameras(const vision::ImageCorrection& images, double scale);
  void addToHistory(registration::HistoryEntry entry);
  void readHistory();
  void useAgain(const registration::HistoryEntry& entry);

  Views views_;
  SessionLink& link_;
  double now_ = 0.0;  ///< newest session time [s]
  std::optional<Eigen::Isometry3d> in_use_;
  std::optional<Eigen::Isometry3d> accepted_;  ///< accepted by a user for this source
  vision::ImageCorrection images_;             ///< correction of the source's images, in use
  double scale_ = 1.0;                         ///< of the source's base line, in use
  bool of_poses_ = false;                      ///< the registration in use was fitted to the panel's poses
  SourceChoice choice_;                        ///< of the open source
  CameraUse poses_by_;                         ///< with which the panel's poses were taken
  QString poses_session_;                      ///< title of the session of the panel's poses
};

}  // namespace capstan::widgets
