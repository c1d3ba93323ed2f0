#pragma once

#include <QPainter>
#include <QSize>
#include <array>
#include <optional>

#include "core/tracking/snapshot.h"
#include "widgets/figures/theme.h"
#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/tension_scale.h"
#include "widgets/scene/workspace_grid.h"

/// Words and scales over the rendered scene, drawn by Qt: sharper than text in the scene, and in the theme's
/// fonts.
namespace capstan::widgets {

struct SceneCaptions {
  std::array<std::optional<Eigen::Vector3d>, 2> cameras;  ///< apex of left and right frustum [m]
  std::array<bool, 2> seen{};
  double ellipsoid_scale = 1.0;                         ///< how much larger than life the ellipsoid is drawn
  Eigen::Vector3d tip_sigma = Eigen::Vector3d::Zero();  ///< along frame 0's axes [m]
  Eigen::Vector3d tension = Eigen::Vector3d::Zero();    ///< [N]
};

/// Names of the axes and as many of their numbers as do not cover one another.
void drawGridLabels(QPainter& painter, const WorkspaceGrid& grid, const OrbitCamera& camera,
                    const QSize& size, const Theme& theme);
void drawCameraLabels(QPainter& painter, const SceneCaptions& captions, const OrbitCamera& camera,
                      const QSize& size, const Theme& theme);
/// Colour bar with the joints' cable forces beside it, lower right.
void drawTensionLegend(QPainter& painter, const SceneCaptions& captions, const TensionScale& scale,
                       const QSize& size, const Theme& theme);
/// What the ellipsoid and the trail are, top left.
void drawSceneKey(QPainter& painter, const SceneCaptions& captions, double trail_seconds, const Theme& theme);

}  // namespace capstan::widgets
