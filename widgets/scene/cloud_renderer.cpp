#include "widgets/scene/cloud_renderer.h"

#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

#include "widgets/scene/vtk_shapes.h"

namespace capstan::widgets {

namespace {

vtkSmartPointer<vtkActor> actorOfCloud(const PointCloud& cloud) {
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto cells = vtkSmartPointer<vtkCellArray>::New();
  for (const Eigen::Vector3d& point : cloud.points) {
    cells->InsertNextCell(1);
    cells->InsertCellPoint(points->InsertNextPoint(point.data()));
  }
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetVerts(cells);
  auto actor = lineActorOf(data, 1.0);
  actor->GetProperty()->SetPointSize(static_cast<float>(cloud.size));
  paint(*actor, cloud.colour);
  return actor;
}

}  // namespace

class CloudRenderer::Parts {
 public:
  Parts() {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->AddRenderer(renderer);
    renderer->SetUseFXAA(true);
  }

  vtkSmartPointer<vtkRenderWindow> window = vtkSmartPointer<vtkRenderWindow>::New();
  vtkSmartPointer<vtkRenderer> renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkSmartPointer<vtkUnsignedCharArray> pixels = vtkSmartPointer<vtkUnsignedCharArray>::New();
  vtkSmartPointer<vtkActor> grid;
  std::vector<vtkSmartPointer<vtkActor>> clouds;
  QColor grid_colour;
};

CloudRenderer::CloudRenderer() : parts_(std::make_unique<Parts>()) {}
CloudRenderer::~CloudRenderer() = default;

void CloudRenderer::setColours(const QColor& background, const QColor& grid) {
  parts_->renderer->SetBackground(background.redF(), background.greenF(), background.blueF());
  parts_->grid_colour = grid;
  if (parts_->grid) paint(*parts_->grid, grid);
}

void CloudRenderer::setGrid(const WorkspaceGrid& grid) {
  if (parts_->grid) parts_->renderer->RemoveActor(parts_->grid);
  parts_->grid = lineActorOf(lineData(grid.lines), 1.0);
  paint(*parts_->grid, parts_->grid_colour);
  parts_->renderer->AddActor(parts_->grid);
}

void CloudRenderer::setClouds(const std::vector<PointCloud>& clouds) {
  for (const auto& actor : parts_->clouds) parts_->renderer->RemoveActor(actor);
  parts_->clouds.clear();
  for (const PointCloud& cloud : clouds) {
    if (!cloud.shown || cloud.points.empty()) continue;
    parts_->clouds.push_back(actorOfCloud(cloud));
    parts_->renderer->AddActor(parts_->clouds.back());
  }
}

QImage CloudRenderer::render(const OrbitCamera& camera, const QSize& size) {
  if (size.isEmpty()) return {};
  auto* view = parts_->renderer->GetActiveCamera();
  const Eigen::Vector3d from = camera.position(), to = camera.focus(), up = camera.viewUp();
  view->SetPosition(from.data());
  view->SetFocalPoint(to.data());
  view->SetViewUp(up.data());
  view->SetViewAngle(camera.viewAngle() * 180.0 / M_PI);
  view->SetClippingRange(0.01, 20.0);
  parts_->window->SetSize(size.width(), size.height());
  parts_->window->Render();
  parts_->window->GetRGBACharPixelData(0, 0, size.width() - 1, size.height() - 1, 0, parts_->pixels);
  const QImage bottom_up(parts_->pixels->GetPointer(0), size.width(), size.height(), 4 * size.width(),
                         QImage::Format_RGBX8888);
  return bottom_up.mirrored().convertToFormat(QImage::Format_RGB32);
}

}  // namespace capstan::widgets
