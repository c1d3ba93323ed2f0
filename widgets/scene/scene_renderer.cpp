#include "widgets/scene/scene_renderer.h"

#include <vtkCellArray.h>
#include <vtkLight.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <Eigen/Eigenvalues>
#include <cstring>

#include "widgets/scene/vtk_shapes.h"

namespace capstan::widgets {

namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;

constexpr double kFrustumDepth = 0.10;  // [m]

/// Lines of a frustum: from the apex to the four corners of the image, and around the corners, in the
/// camera's frame.
LineSegments frustum(const vision::Camera& camera) {
  std::array<Vector3d, 4> corner;
  for (std::size_t i = 0; i < 4; ++i) {
    const double x = (i == 1 || i == 2) ? camera.width - 0.5 : -0.5, y = i >= 2 ? camera.height - 0.5 : -0.5;
    corner[i] = kFrustumDepth * Vector3d((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
  }
  LineSegments lines;
  for (std::size_t i = 0; i < 4; ++i) {
    lines.emplace_back(Vector3d::Zero(), corner[i]);
    lines.emplace_back(corner[i], corner[(i + 1) % 4]);
  }
  const Vector3d middle = 0.5 * (corner[0] + corner[1]);
  lines.emplace_back(0.8 * corner[0] + 0.2 * corner[1], middle * 1.0 + 0.25 * (corner[0] - corner[3]));
  lines.emplace_back(0.2 * corner[0] + 0.8 * corner[1], middle * 1.0 + 0.25 * (corner[0] - corner[3]));
  return lines;
}

}  // namespace

class SceneRenderer::Parts : public OffScreen {
 public:
  Parts() {
    trail->SetPoints(vtkSmartPointer<vtkPoints>::New());
    trail_actor = lineActorOf(trail, 3.0);
    ellipsoid = actorOf(sphereSurface(1.0, 28));
    ellipsoid->GetProperty()->SetOpacity(0.55);
    centre = actorOf(sphereSurface(0.006, 16));
    renderer->AddActor(trail_actor);
    renderer->AddActor(ellipsoid);
    renderer->AddActor(centre);
  }

  struct Placed {
    vtkSmartPointer<vtkActor> actor;
    int frame;
    int cable;  // −1: structure, −2: shaft, −3: marker
  };

  void add(const std::vector<Tube>& tubes, int cable) {
    for (int frame = 0; frame < 4; ++frame)
      if (const auto surface = tubeSurface(tubes, frame)) add({actorOf(surface), frame, cable});
  }
  void add(Placed part) {
    renderer->AddActor(part.actor);
    arm.push_back(std::move(part));
  }
  void remove(vtkSmartPointer<vtkActor>& actor) {
    if (actor) renderer->RemoveActor(actor);
    actor = nullptr;
  }

  void colour() {
    const auto set = [](vtkRenderer& r, const QColor& c) {
      r.SetBackground(c.redF(), c.greenF(), c.blueF());
    };
    set(*renderer, theme.surface);
    const QColor metal = theme.isDark() ? QColor("#8d99a6") : QColor("#9aa4ae");
    for (auto& part : arm) {
      if (part.cable == -1) paint(*part.actor, metal);
      if (part.cable == -2) paint(*part.actor, theme.isDark() ? QColor("#c9d1d9") : QColor("#5b6570"));
      if (part.cable == -3) paint(*part.actor, QColor("#35c46a"));
    }
    if (grid) paint(*grid, theme.isDark() ? theme.border : theme.border.darker(105));
    paint(*trail_actor, theme.colour(Quantity::kUkf));
    paint(*ellipsoid, theme.colour(Quantity::kUkf).lighter(theme.isDark() ? 140 : 110));
    paint(*centre, theme.muted);
  }

  void showTrail(const std::vector<Vector3d>& points) {
    const auto positions = vtkSmartPointer<vtkPoints>::New();
    const auto cells = vtkSmartPointer<vtkCellArray>::New();
    const auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetNumberOfComponents(4);
    const QColor ink = theme.colour(Quantity::kUkf);
    if (points.size() > 1) cells->InsertNextCell(static_cast<int>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto id = positions->InsertNextPoint(points[i].data());
      if (points.size() > 1) cells->InsertCellPoint(id);
      const auto alpha = static_cast<unsigned char>(30 + 225 * i / points.size());
      const unsigned char rgba[4] = {static_cast<unsigned char>(ink.red()),
                                     static_cast<unsigned char>(ink.green()),
                                     static_cast<unsigned char>(ink.blue()), alpha};
      colours->InsertNextTypedTuple(rgba);
    }
    trail->SetPoints(positions);
    trail->SetLines(cells);
    trail->GetPointData()->SetScalars(colours);
    trail_actor->SetVisibility(points.size() > 1);
  }

  void showEllipsoid(const Vector3d& at, const Eigen::Matrix3d& covariance) {
    const bool shown = covariance.allFinite() && at.allFinite() && covariance.trace() > 0.0;
    ellipsoid->SetVisibility(shown);
    if (!shown) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(covariance);
    Matrix4d m = Matrix4d::Identity();
    m.topLeftCorner<3, 3>() = axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
    m.topRightCorner<3, 1>() = at;
    place(*ellipsoid, m);
  }

  void showRays(const ScenePose& pose) {
    for (std::size_t side = 0; side < 2; ++side) {
      remove(rays[side]);
      if (frusta[side]) paint(*frusta[side], colourOf(pose.marker[side], theme));
      if (!frusta[side] || pose.marker[side] != MarkerVisibility::kSeen || !pose.tip.allFinite()) continue;
      rays[side] = lineActorOf(lineData({{apex[side], pose.tip}}), 1.0);
      rays[side]->GetProperty()->SetOpacity(0.45);
      paint(*rays[side], theme.colour(Quantity::kCamera));
      renderer->AddActor(rays[side]);
    }
  }

  vtkSmartPointer<vtkPolyData> trail = vtkSmartPointer<vtkPolyData>::New();
  vtkSmartPointer<vtkActor> trail_actor, ellipsoid, centre, grid;
  std::array<vtkSmartPointer<vtkActor>, 2> frusta, rays;
  std::array<Vector3d, 2> apex;
  std::vector<Placed> arm;
  Theme theme = Theme::dark();
};

SceneRenderer::SceneRenderer() : parts_(std::make_unique<Parts>()) { parts_->colour(); }
SceneRenderer::~SceneRenderer() = default;

void SceneRenderer::setTheme(const Theme& theme) {
  parts_->theme = theme;
  parts_->colour();
}

void SceneRenderer::setArm(const ArmShape& shape) {
  for (auto& part : parts_->arm) parts_->renderer->RemoveActor(part.actor);
  parts_->arm.clear();
  parts_->add(shape.links, -1);
  parts_->add(shape.shaft, -2);
  for (int i = 0; i < 3; ++i) parts_->add(shape.cables[static_cast<std::size_t>(i)], i);
  const auto ball = actorOf(sphereSurface(shape.marker_radius, 20));
  ball->SetPosition(shape.marker.x(), shape.marker.y(), shape.marker.z());
  parts_->add({ball, 3, -3});
  parts_->colour();
}

void SceneRenderer::setGrid(const WorkspaceGrid& grid) {
  parts_->remove(parts_->grid);
  parts_->grid = lineActorOf(lineData(grid.lines), 1.0);
  parts_->renderer->AddActor(parts_->grid);
  parts_->colour();
}

void SceneRenderer::setRig(const std::optional<vision::StereoRig>& rig,
                           const std::optional<Eigen::Isometry3d>& base_from_camera) {
  for (std::size_t side = 0; side < 2; ++side) {
    parts_->remove(parts_->frusta[side]);
    parts_->remove(parts_->rays[side]);
    if (!rig || !base_from_camera) continue;
    const Eigen::Isometry3d pose =
        side == 0 ? *base_from_camera : Eigen::Isometry3d(*base_from_camera * rig->right_from_left.inverse());
    parts_->frusta[side] = lineActorOf(lineData(frustum(side == 0 ? rig->left : rig->right)), 2.0);
    place(*parts_->frusta[side], pose.matrix());
    parts_->apex[side] = pose.translation();
    parts_->renderer->AddActor(parts_->frusta[side]);
  }
}

void SceneRenderer::pose(const ScenePose& pose) {
  for (auto& part : parts_->arm) {
    place(*part.actor, pose.frames[static_cast<std::size_t>(part.frame)].matrix());
    if (part.cable >= 0) paint(*part.actor, pose.cables[static_cast<std::size_t>(part.cable)]);
  }
  parts_->showTrail(pose.trail);
  parts_->showEllipsoid(pose.tip, pose.ellipsoid);
  parts_->showRays(pose);
}

QImage SceneRenderer::render(const OrbitCamera& camera, const QSize& size) {
  constexpr double kNearest = 0.02;  // [m]
  return parts_->render(camera, size, kNearest);
}

}  // namespace capstan::widgets
