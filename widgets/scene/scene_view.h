#pragma once

#include <QImage>
#include <QTimer>
#include <QWidget>
#include <deque>
#include <memory>
#include <optional>

#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "widgets/figures/theme.h"
#include "widgets/scene/orbit_mouse.h"
#include "widgets/scene/scene_labels.h"

namespace capstan::widgets {

class SceneRenderer;
struct ScenePose;

/// The 3-D view: arm, cables coloured by force, camera frusta, tip trail, 2σ ellipsoid and workspace grid.
/// Left drag orbits, middle or shift drag pans, the wheel zooms, a double click resets the view; more in the
/// context menu. It asks the RenderThread for at most 15 images per second, and only when something changed.
/// Without a display it reports an error.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  /// Whether VTK can draw here: it needs an X display and crashes without one.
  static bool available();

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
  OrbitCamera& camera() { return camera_; }
  void resetCamera();
  /// Draws now and returns the image of the scene without labels. For tests and exports.
  QImage image();

  QSize sizeHint() const override { return {420, 330}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;

 private:
  struct TrailPoint {
    double t;
    Eigen::Vector3d tip;
  };
  bool ready();
  void dropRenderer();
  void changed();
  void draw();
  void take(const QImage& image, const OrbitCamera& camera);
  ScenePose poseNow();
  QSize pixelSize() const;
  void keepTrail(const tracking::Snapshot& snapshot);
  void chooseEllipsoidScale();

  Theme theme_ = Theme::dark();
  std::unique_ptr<SceneRenderer> renderer_;  ///< used in the RenderThread only, and set while it waits
  std::optional<robot::Description> robot_;
  std::optional<robot::ArmKinematics> arm_;
  std::optional<vision::StereoRig> rig_;
  std::optional<Eigen::Isometry3d> base_from_camera_;
  std::optional<tracking::Snapshot> snapshot_;
  std::deque<TrailPoint> trail_;
  double trail_seconds_ = 5.0;
  double asked_scale_ = 0.0;
  OrbitCamera camera_;
  TensionScale tension_;
  WorkspaceGrid grid_;
  SceneCaptions captions_;
  QImage image_;
  OrbitCamera image_camera_;  ///< from which image_ was drawn: its labels fit it
  QTimer timer_;
  bool changed_ = true, drawing_ = false;
  OrbitMouse mouse_;
};

}  // namespace capstan::widgets
