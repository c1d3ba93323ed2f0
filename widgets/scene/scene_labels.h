#pragma once

#include <QPainter>
#include <QSize>
#include <array>
#include <optional>

#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"
#include "widgets/scene/marker_visibility.h"
#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/tension_scale.h"
#include "widgets/scene/workspace_grid.h"

/// Data of the texts and scales over the rendered scene. Qt draws them: sharper than text in the scene, and
/// in the theme's fonts.
namespace capstan::widgets {

struct SceneCaptions {
  std::array<std::optional<Eigen::Vector3d>, 2> cameras;  ///< apex of left and right frustum [m]
  std::array<MarkerVisibility, 2> marker{};
  double ellipsoid_scale = 1.0;                         ///< scale factor of the drawn ellipsoid
  Eigen::Vector3d tip_sigma = Eigen::Vector3d::Zero();  ///< σ along the axes of frame 0 [m]
  Eigen::Vector3d tension = Eigen::Vector3d::Zero();    ///< cable forces [N]
};

/// Draws the names of the axes, and those of their numbers that do not overlap.
void drawGridLabels(QPainter& painter, const WorkspaceGrid& grid, const OrbitCamera& camera,
                    const QSize& size, const Theme& theme);
void drawCameraLabels(QPainter& painter, const SceneCaptions& captions, const OrbitCamera& camera,
                      const QSize& size, const Theme& theme);
/// Draws a colour bar with the joints' cable forces beside it, lower right.
void drawTensionLegend(QPainter& painter, const SceneCaptions& captions, const TensionScale& scale,
                       const QSize& size, const Theme& theme);
/// Draws the key of ellipsoid and trail, top left.
void drawSceneKey(QPainter& painter, const SceneCaptions& captions, double trail_seconds, const Theme& theme);

}  // namespace capstan::widgets
