#pragma once

#include <Eigen/Geometry>
#include <QObject>
#include <optional>

class QDockWidget;

namespace capstan::tracking {
struct SourceInfo;
}
namespace capstan::simulation {
class SimulatedSource;
}

namespace capstan::widgets {

class NotesPanel;
class RegistrationPanel;
class SceneView;
class SessionBar;
class SessionLink;

/// Connects the registration panel to the running session: moves the simulated arm, passes the accepted pose
/// of the cameras to the pipeline and the scene, and adds an entry in the bar and notes.
class RegistrationController : public QObject {
  Q_OBJECT

 public:
  RegistrationController(RegistrationPanel& panel, QDockWidget& dock, SessionLink& link, SessionBar& bar,
                         SceneView& scene, NotesPanel& notes, QObject* parent);

 private:
  void addAction(SessionBar& bar);
  void connectPanel(SceneView& scene, NotesPanel& notes);
  void command(void (simulation::SimulatedSource::*what)());
  void begin();
  void keepAccepted(SceneView& scene, NotesPanel& notes);

  RegistrationPanel& panel_;
  QDockWidget& dock_;
  SessionLink& link_;
  double now_ = 0.0;  ///< newest session time [s]
  std::optional<Eigen::Isometry3d> in_use_;
  std::optional<Eigen::Isometry3d> accepted_;  ///< accepted by a user for this source
};

}  // namespace capstan::widgets
