#include "widgets/scene/vtk_shapes.h"

#include <vtkAppendPolyData.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyLine.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTubeFilter.h>

#include <cmath>

namespace capstan::widgets {

namespace {

vtkSmartPointer<vtkPolyData> polyline(const std::vector<Eigen::Vector3d>& path) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->InsertNextCell(static_cast<int>(path.size()));
  for (const auto& p : path) cells->InsertCellPoint(points->InsertNextPoint(p.data()));
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

}  // namespace

vtkSmartPointer<vtkPolyData> tubeSurface(const std::vector<Tube>& tubes, int frame) {
  const auto all = vtkSmartPointer<vtkAppendPolyData>::New();
  bool any = false;
  for (const Tube& tube : tubes) {
    if (tube.frame != frame) continue;
    const auto filter = vtkSmartPointer<vtkTubeFilter>::New();
    filter->SetInputData(polyline(tube.path));
    filter->SetRadius(tube.radius);
    filter->SetNumberOfSides(tube.radius > 0.005 ? 18 : 8);
    filter->CappingOn();
    filter->Update();
    all->AddInputData(filter->GetOutput());
    any = true;
  }
  if (!any) return nullptr;
  all->Update();
  return all->GetOutput();
}

vtkSmartPointer<vtkPolyData> sphereSurface(double radius, int resolution) {
  const auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> lineData(const LineSegments& segments) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& [from, to] : segments) {
    cells->InsertNextCell(2);
    cells->InsertCellPoint(points->InsertNextPoint(from.data()));
    cells->InsertCellPoint(points->InsertNextPoint(to.data()));
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetLines(cells);
  return data;
}

vtkSmartPointer<vtkActor> actorOf(vtkPolyData* data) {
  const auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(data);
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.8);
  actor->GetProperty()->SetSpecular(0.15);
  return actor;
}

vtkSmartPointer<vtkActor> lineActorOf(vtkPolyData* data, double width) {
  auto actor = actorOf(data);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  return actor;
}

void place(vtkActor& actor, const Eigen::Matrix4d& transform) {
  auto* matrix = actor.GetUserMatrix();
  if (matrix == nullptr) {
    const auto fresh = vtkSmartPointer<vtkMatrix4x4>::New();
    actor.SetUserMatrix(fresh);
    matrix = fresh;
  }
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, transform(row, column));
  matrix->Modified();
}

void paint(vtkActor& actor, const QColor& colour) {
  actor.GetProperty()->SetColor(colour.redF(), colour.greenF(), colour.blueF());
}

OffScreen::OffScreen() {
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  renderer->SetUseFXAA(true);
}

QImage OffScreen::render(const OrbitCamera& camera, const QSize& size, double nearest) {
  if (size.isEmpty()) return {};
  constexpr double kFarthest = 20.0;  // [m]
  auto* view = renderer->GetActiveCamera();
  const Eigen::Vector3d from = camera.position(), to = camera.focus(), up = camera.viewUp();
  view->SetPosition(from.data());
  view->SetFocalPoint(to.data());
  view->SetViewUp(up.data());
  view->SetViewAngle(camera.viewAngle() * 180.0 / M_PI);
  view->SetClippingRange(nearest, kFarthest);
  window->SetSize(size.width(), size.height());
  window->Render();
  window->GetRGBACharPixelData(0, 0, size.width() - 1, size.height() - 1, 0, pixels);
  const QImage bottom_up(pixels->GetPointer(0), size.width(), size.height(), 4 * size.width(),
                         QImage::Format_RGBX8888);
  return bottom_up.mirrored().convertToFormat(QImage::Format_RGB32);
}

}  // namespace capstan::widgets
