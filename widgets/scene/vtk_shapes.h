#pragma once

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <QColor>
#include <utility>
#include <vector>

#include "widgets/scene/arm_shape.h"

/// The few VTK shapes that the scene is made of.
namespace capstan::widgets {

using LineSegments = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

/// The tubes of `frame` as one surface; null when there are none.
vtkSmartPointer<vtkPolyData> tubeSurface(const std::vector<Tube>& tubes, int frame);
vtkSmartPointer<vtkPolyData> sphereSurface(double radius, int resolution);
vtkSmartPointer<vtkPolyData> lineData(const LineSegments& segments);

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data);
/// A flat line drawing of `width` pixels.
vtkSmartPointer<vtkActor> lineActorOf(vtkPolyData* data, double width);
void place(vtkActor& actor, const Eigen::Matrix4d& transform);
void paint(vtkActor& actor, const QColor& colour);

}  // namespace capstan::widgets
