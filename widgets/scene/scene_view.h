#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "widgets/figures/theme.h"
#include "widgets/scene/rendered_view.h"
#include "widgets/scene/scene_labels.h"

namespace capstan::widgets {

class SceneRenderer;
struct ScenePose;

/// The 3-D view: arm, cables coloured by force, camera frusta, tip trail, 2σ ellipsoid and workspace grid.
/// More views are in the context menu. Without a display it reports an error.
class SceneView : public RenderedView {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  void setTheme(const Theme& theme);
  /// Sets the arm, its cameras and their registration for another source; clears the trail.
  void setRobot(const robot::Description& robot, const std::optional<vision::StereoRig>& rig,
                const std::optional<Eigen::Isometry3d>& base_from_camera);
  void setRegistration(const std::optional<Eigen::Isometry3d>& base_from_camera);
  void showSnapshot(const tracking::Snapshot& snapshot);

  void setTrailSeconds(double seconds) { trail_seconds_ = seconds; }
  /// Sets the scale factor of the drawn ellipsoid; 0 selects a round factor that keeps it visible.
  void setEllipsoidScale(double factor);
  double ellipsoidScale() const { return captions_.ellipsoid_scale; }
  void resetCamera() override;

  QSize sizeHint() const override { return {420, 330}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct TrailPoint {
    double t;
    Eigen::Vector3d tip;
  };
  Drawing drawing() override;
  void configure();
  ScenePose pose();
  void keepTrail(const tracking::Snapshot& snapshot);
  void chooseEllipsoidScale();

  Theme theme_ = Theme::dark();
  std::unique_ptr<SceneRenderer> renderer_;  ///< for the RenderThread only
  bool configured_ = false;  ///< the renderer has this robot, after the tasks that were posted
  std::optional<robot::Description> robot_;
  std::optional<robot::ArmKinematics> arm_;
  std::optional<vision::StereoRig> rig_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  std::optional<tracking::Snapshot> snapshot_;
  std::deque<TrailPoint> trail_;
  double trail_seconds_ = 5.0;
  double asked_scale_ = 0.0;
  TensionScale tension_;
  WorkspaceGrid grid_;
  SceneCaptions captions_;
};

}  // namespace capstan::widgets
