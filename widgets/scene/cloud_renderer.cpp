#include "widgets/scene/cloud_renderer.h"

#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkProperty.h>

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

class CloudRenderer::Parts : public OffScreen {
 public:
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
  constexpr double kNearest = 0.01;  // [m]
  return parts_->render(camera, size, kNearest);
}

}  // namespace capstan::widgets
