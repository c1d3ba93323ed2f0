#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Geometry>
#include <QColor>
#include <QImage>
#include <utility>
#include <vector>

#include "widgets/scene/arm_shape.h"
#include "widgets/scene/orbit_camera.h"

/// VTK shapes of the scene, and their off-screen rendering.
namespace capstan::widgets {

using LineSegments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// The tubes of `frame` as one surface; null if there are none.
vtkSmartPointer<vtkPolyData> tubeSurface(const std::vector<Tube>& tubes, int frame);
vtkSmartPointer<vtkPolyData> sphereSurface(double radius, int resolution);
vtkSmartPointer<vtkPolyData> lineData(const LineSegments& segments);

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data);
/// Actor of unshaded lines; `width` [px].
vtkSmartPointer<vtkActor> lineActorOf(vtkPolyData* data, double width);
void place(vtkActor& actor, const Eigen::Matrix4d& transform);
void paint(vtkActor& actor, const QColor& colour);

/// An off-screen window with one renderer, whose image is read back.
struct OffScreen {
  OffScreen();
  /// Renders as `camera` sees it; `nearest`: distance of the near clipping plane [m]. Null for an empty
  /// `size`.
  QImage render(const OrbitCamera& camera, const QSize& size, double nearest);

  vtkSmartPointer<vtkRenderWindow> window = vtkSmartPointer<vtkRenderWindow>::New();
  vtkSmartPointer<vtkRenderer> renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkSmartPointer<vtkUnsignedCharArray> pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
};

}  // namespace capstan::widgets
