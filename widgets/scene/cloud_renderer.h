#pragma once

#include <Eigen/Core>
#include <QColor>
#include <QImage>
#include <QString>
#include <memory>
#include <vector>

#include "widgets/scene/orbit_camera.h"
#include "widgets/scene/workspace_grid.h"

namespace capstan::widgets {

/// Positions of one kind.
struct PointCloud {
  QString name = {};
  QColor colour = {};
  double size = 2.5;  ///< of a point [px]
  bool shown = true;
  bool framed = true;                        ///< the grid is around it
  std::vector<Eigen::Vector3d> points = {};  ///< [m]
};

/// The VTK side of a view of point clouds: an off-screen render window whose picture is read back. Needs an X
/// display: VTK crashes without one, so ask SceneView::available() first.
class CloudRenderer {
 public:
  CloudRenderer();
  ~CloudRenderer();
  CloudRenderer(const CloudRenderer&) = delete;
  CloudRenderer& operator=(const CloudRenderer&) = delete;

  void setColours(const QColor& background, const QColor& grid);
  void setGrid(const WorkspaceGrid& grid);
  /// Those shown, the first drawn first.
  void setClouds(const std::vector<PointCloud>& clouds);
  QImage render(const OrbitCamera& camera, const QSize& size);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::widgets
