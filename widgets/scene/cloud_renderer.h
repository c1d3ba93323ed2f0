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

/// Positions of one kind, with their style.
struct PointCloud {
  QString name = {};
  QColor colour = {};
  double size = 2.5;  ///< size of a point [px]
  bool shown = true;
  bool framed = true;                        ///< the grid encloses it
  std::vector<Eigen::Vector3d> points = {};  ///< positions [m]
};

/// VTK part of a view of point clouds: an off-screen render window whose image is read back. It needs an X
/// display; VTK crashes without one, so call RenderedView::available() first.
class CloudRenderer {
 public:
  CloudRenderer();
  ~CloudRenderer();
  CloudRenderer(const CloudRenderer&) = delete;
  CloudRenderer& operator=(const CloudRenderer&) = delete;

  void setColours(const QColor& background, const QColor& grid);
  void setGrid(const WorkspaceGrid& grid);
  /// Sets the clouds. Only shown ones are drawn, the first one first.
  void setClouds(const std::vector<PointCloud>& clouds);
  QImage render(const OrbitCamera& camera, const QSize& size);

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace capstan::widgets
