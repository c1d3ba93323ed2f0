#include "core/simulation/renderer.h"

#include <cmath>
#include <numbers>

#include "core/simulation/background.h"
#include "core/simulation/image_noise.h"
#include "core/simulation/tool_painter.h"

namespace capstan::simulation {
namespace {

constexpr int kDisparity = 42;  // disparity of a background at 0.75 m: 650 px · 48 mm / 0.75 m [px]

}  // namespace

/// Data that render() needs and outline() does not; made at the first image.
struct CameraRenderer::Drawing {
  Drawing(const vision::Camera& camera, const SceneSizes& sizes, const ImageTruth& appearance,
          std::uint64_t seed, int side)
      : background(makeBackground(camera.width, camera.height, appearance, seed, side == 0 ? 0 : kDisparity)),
        painter(camera, sizes, appearance, background.light),
        noise(camera.width, camera.height, appearance.noise, appearance.exposure_noise,
              2 * seed + static_cast<std::uint64_t>(side)) {}

  Background background;
  ToolPainter painter;
  ImageNoise noise;
};

CameraRenderer::CameraRenderer(const vision::Camera& camera, const Eigen::Isometry3d& camera_from_base,
                               const SceneSizes& sizes, const ImageTruth& appearance, double exposure,
                               std::uint64_t seed, int side)
    : camera_(camera),
      camera_from_base_(camera_from_base),
      sizes_(sizes),
      appearance_(appearance),
      exposure_(exposure),
      seed_(seed),
      side_(side) {}
CameraRenderer::~CameraRenderer() = default;
CameraRenderer::CameraRenderer(CameraRenderer&&) noexcept = default;

void CameraRenderer::render(const ToolPose& pose, cv::Mat& image) {
  if (!drawing_) drawing_ = std::make_unique<Drawing>(camera_, sizes_, appearance_, seed_, side_);
  drawing_->background.image.copyTo(image);
  const Eigen::Matrix3d rotation = camera_from_base_.linear();
  drawing_->painter.paint(camera_from_base_ * pose.tip, rotation * pose.axis,
                          0.5 * exposure_ * (rotation * pose.velocity), image);
  drawing_->noise.apply(image);
}

/// Outline of the sphere. The rays of its silhouette form a cone about the centre c with half angle asin(r /
/// |c|).
RenderedMarker CameraRenderer::outline(const ToolPose& pose) const {
  constexpr int kRays = 96;
  const Eigen::Vector3d centre = camera_from_base_ * pose.tip;
  RenderedMarker seen;
  const auto middle = camera_.project(centre);
  if (!middle || centre.norm() <= sizes_.marker_radius) return seen;
  seen.sphere_centre = *middle;
  seen.in_view = true;

  const Eigen::Vector3d along = centre.normalized(), right = along.unitOrthogonal(), up = along.cross(right);
  const double sine = sizes_.marker_radius / centre.norm(), cosine = std::sqrt(1.0 - sine * sine);
  std::array<Eigen::Vector2d, kRays> edge;
  for (int i = 0; i < kRays; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kRays;
    const auto pixel =
        camera_.project(cosine * along + sine * (std::cos(angle) * right + std::sin(angle) * up));
    if (!pixel) return RenderedMarker{};
    edge[static_cast<std::size_t>(i)] = *pixel - *middle;
    seen.in_view &= pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() <= camera_.width - 1.0 &&
                    pixel->y() <= camera_.height - 1.0;
  }
  double area = 0.0;
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const Eigen::Vector2d &a = edge[i], &b = edge[(i + 1) % edge.size()];
    const double slice = a.x() * b.y() - b.x() * a.y();
    area += 0.5 * slice;
    moment += slice * (a + b) / 6.0;
  }
  seen.ellipse_centre = *middle + moment / area;
  seen.radius = std::sqrt(std::abs(area) / std::numbers::pi);
  return seen;
}

}  // namespace capstan::simulation
