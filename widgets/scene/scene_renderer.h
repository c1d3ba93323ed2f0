#pragma once

#include <Eigen/Geometry>
#include <QColor>
#include <QImage>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "core/vision/camera.h"
#include "widgets/figures/theme.h"
#include "widgets/scene/arm_shape.h"
#include "widgets/scene/marker_visibility.h"
#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/workspace_grid.h"

namespace capstan::widgets {

/// Moving parts of the scene, in frame 0 [m].
struct ScenePose {
  std::array<Eigen::Isometry3d, 4> frames;  ///< frames of the arm
  std::array<QColor, 3> cables;
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  Eigen::Matrix3d ellipsoid = Eigen::Matrix3d::Zero();  ///< scaled covariance; zero: not drawn
  std::vector<Eigen::Vector3d> trail;                   ///< trail of the tip, oldest point first
  std::array<MarkerVisibility, 2> marker{};             ///< of left and right camera
};

/// VTK part of the 3-D view: an off-screen render window whose image is read back. It needs an X display; VTK
/// crashes without one, so call RenderedView::available() first.
class SceneRenderer {
 public:
  SceneRenderer();
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  void setTheme(const Theme& theme);
  void setArm(const ArmShape& shape);
  void setGrid(const WorkspaceGrid& grid);
  /// Sets the camera frusta, in frame 0; without rig or registration none are drawn.
  void setRig(const std::optional<vision::StereoRig>& rig,
              const std::optional<Eigen::Isometry3d>& base_from_camera);
  void pose(const ScenePose& pose);
  QImage render(const OrbitCamera& camera, const QSize& size);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::widgets
