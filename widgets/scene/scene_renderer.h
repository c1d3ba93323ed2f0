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
#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/workspace_grid.h"

namespace capstan::widgets {

/// What moves in the scene, frame 0, metres.
struct ScenePose {
  std::array<Eigen::Isometry3d, 4> frames;  ///< of the arm
  std::array<QColor, 3> cables;
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();
  Eigen::Matrix3d ellipsoid = Eigen::Matrix3d::Zero();  ///< covariance as it is to be drawn; zero: none
  std::vector<Eigen::Vector3d> trail;                   ///< oldest first
  std::array<bool, 2> seen{};                           ///< left, right camera sees the marker
};

/// The VTK side of the 3-D view: an off-screen render window whose picture is read back. Needs an X display:
/// VTK crashes without one, so ask SceneView::available() first.
class SceneRenderer {
 public:
  SceneRenderer();
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  void setTheme(const Theme& theme);
  void setArm(const ArmShape& shape);
  void setGrid(const WorkspaceGrid& grid);
  /// Camera frusta in frame 0; nothing: none are drawn.
  void setRig(const std::optional<vision::StereoRig>& rig,
              const std::optional<Eigen::Isometry3d>& base_from_camera);
  void pose(const ScenePose& pose);
  QImage render(const OrbitCamera& camera, const QSize& size);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::widgets
