#include "core/simulation/tool_painter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace capstan::simulation {
namespace {

const Eigen::Vector3f kLamp = Eigen::Vector3f(-0.35F, -0.6F, -0.72F).normalized();  // towards the lamp
const Eigen::Vector3f kSteel(110.0F, 105.0F, 100.0F);

float lambert(const Eigen::Vector3f& normal) { return 0.55F + 0.5F * std::max(0.0F, normal.dot(kLamp)); }

}  // namespace

ToolPainter::ToolPainter(const vision::Camera& camera, const SceneSizes& sizes, const ImageTruth& appearance,
                         const cv::Mat& light)
    : camera_(camera),
      grid_(camera),
      sizes_(sizes),
      light_(light),
      marker_colour_(bgrOf(appearance.marker_hue, 195.0, 215.0)),
      spans_(static_cast<std::size_t>(camera.height)) {}

void ToolPainter::paint(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis, const Eigen::Vector3d& smear,
                        cv::Mat& image) {
  paintShaft(tip, axis, image);
  paintMarker(tip, axis, smear, image);
}

/// Coverage by the sphere |x − c| = r along ray d. f(d) = (d·c)² − |d|² (|c|² − r²) is positive inside the
/// silhouette; f / |∇f| is the signed distance to it in the normalised image.
ToolPainter::Cover ToolPainter::marker(const Eigen::Vector3f& d, const Eigen::Vector3f& c) const {
  const auto radius = static_cast<float>(sizes_.marker_radius);
  const float dc = d.dot(c), dd = d.squaredNorm(), tangent = c.squaredNorm() - radius * radius;
  const float f = dc * dc - dd * tangent;
  const Eigen::Vector2f slope = 2.0F * (dc * c.head<2>() - tangent * d.head<2>());
  const float distance = static_cast<float>(camera_.fx) * f / std::max(slope.norm(), 1e-9F);  // [px]
  Cover cover;
  cover.share = std::clamp(0.5F + distance, 0.0F, 1.0F);
  if (cover.share <= 0.0F) return cover;
  const float reach = (dc - std::sqrt(std::max(0.0F, f))) / dd;  // x = reach · d
  const Eigen::Vector3f normal = (reach * d - c).normalized();
  cover.depth = reach;
  cover.colour = lambert(normal) * marker_colour_;
  return cover;
}

/// Coverage by the cylinder about tip + s axis, 0 <= s <= length. A ray at distance w from the axis meets it
/// where |w| <= r.
ToolPainter::Cover ToolPainter::shaft(const Eigen::Vector3f& d, const Eigen::Vector3f& p,
                                      const Eigen::Vector3f& a) const {
  Cover cover;
  const auto radius = static_cast<float>(sizes_.shaft_radius);
  const Eigen::Vector3f across = d.cross(a);
  const float sine = across.norm();
  if (sine < 1e-4F) return cover;
  const Eigen::Vector3f normal = across / sine;
  const float w = p.dot(normal);  // signed distance of ray and axis
  const float da = d.dot(a), dd = d.squaredNorm();
  const float s = (da * p.dot(d) - dd * p.dot(a)) / (dd - da * da);  // point of the axis closest to the ray
  if (s < 0.0F || s > static_cast<float>(sizes_.shaft_length)) return cover;
  const float depth = (p + s * a).z();
  if (depth < 0.05F) return cover;
  cover.share =
      std::clamp(0.5F + (radius - std::abs(w)) * static_cast<float>(camera_.fx) / depth, 0.0F, 1.0F);
  if (cover.share <= 0.0F) return cover;
  const float side = std::clamp(-w / radius, -1.0F, 1.0F), front = std::sqrt(1.0F - side * side);
  const Eigen::Vector3f towards = a.cross(normal);  // across the axis, in the plane of the ray
  const Eigen::Vector3f outward = side * normal + (towards.dot(d) < 0.0F ? front : -front) * towards;
  cover.depth = depth - radius * front;
  cover.colour = lambert(outward) * kSteel;
  return cover;
}

void ToolPainter::blend(cv::Mat& image, int u, int v, const Eigen::Vector3f& colour, float share) const {
  cv::Vec3b& pixel = image.at<cv::Vec3b>(v, u);
  const float light = light_.at<float>(v, u);
  for (int c = 0; c < 3; ++c)
    pixel[c] = cv::saturate_cast<std::uint8_t>((1.0F - share) * pixel[c] + light * colour[c]);
}

void ToolPainter::spanShaft(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis) {
  constexpr int kPieces = 48;
  std::fill(spans_.begin(), spans_.end(), Span{grid_.width(), 0});
  std::optional<Eigen::Vector2d> last;
  for (int i = 0; i <= kPieces; ++i) {
    const Eigen::Vector3d point = tip + sizes_.shaft_length * i / kPieces * axis;
    const auto pixel = point.z() > 0.05 ? camera_.project(point) : std::nullopt;
    if (pixel && last) {
      const double margin = camera_.fx * sizes_.shaft_radius / point.z() * 1.3 + 2.0;
      const auto [top, bottom] = std::minmax(pixel->y(), last->y());
      const auto [left, right] = std::minmax(pixel->x(), last->x());
      const int first = static_cast<int>(std::clamp(top - margin, 0.0, double(grid_.height())));
      const int end = static_cast<int>(std::clamp(bottom + margin + 1.0, 0.0, double(grid_.height())));
      for (int v = first; v < end; ++v) {
        Span& span = spans_[static_cast<std::size_t>(v)];
        span.begin =
            std::min(span.begin, static_cast<int>(std::clamp(left - margin, 0.0, double(grid_.width()))));
        span.end = std::max(span.end,
                            static_cast<int>(std::clamp(right + margin + 1.0, 0.0, double(grid_.width()))));
      }
    }
    last = pixel;
  }
}

void ToolPainter::paintShaft(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis, cv::Mat& image) {
  spanShaft(tip, axis);
  const Eigen::Vector3f p = tip.cast<float>(), a = axis.cast<float>();
  for (int v = 0; v < grid_.height(); ++v) {
    const Span span = spans_[static_cast<std::size_t>(v)];
    for (int u = span.begin; u < span.end; ++u) {
      const Cover cover = shaft(grid_.ray(u, v), p, a);
      if (cover.share > 0.0F) blend(image, u, v, cover.share * cover.colour, cover.share);
    }
  }
}

void ToolPainter::paintMarker(const Eigen::Vector3d& tip, const Eigen::Vector3d& axis,
                              const Eigen::Vector3d& smear, cv::Mat& image) const {
  const auto middle = camera_.project(tip);
  if (!middle || tip.z() < 0.05) return;
  const double travel = camera_.fx * smear.norm() / tip.z();  // motion to either side [px]
  const double reach = 1.3 * camera_.fx * sizes_.marker_radius / tip.z() + travel + 3.0;
  const int places = std::clamp(static_cast<int>(std::ceil(3.0 * travel)), 1, 24);
  const auto from = [&](double centre, int size) {
    return std::clamp(static_cast<int>(centre - reach), 0, size);
  };
  const auto to = [&](double centre, int size) {
    return std::clamp(static_cast<int>(centre + reach) + 2, 0, size);
  };
  const Eigen::Vector3f a = axis.cast<float>();
  for (int v = from(middle->y(), grid_.height()); v < to(middle->y(), grid_.height()); ++v)
    for (int u = from(middle->x(), grid_.width()); u < to(middle->x(), grid_.width()); ++u) {
      const Eigen::Vector3f ray = grid_.ray(u, v);
      Eigen::Vector3f colour = Eigen::Vector3f::Zero();
      float share = 0.0F;
      for (int i = 0; i < places; ++i) {
        const double along = (2.0 * i + 1.0) / places - 1.0;
        const Eigen::Vector3f centre = (tip + along * smear).cast<float>();
        Cover seen = marker(ray, centre);
        if (seen.share <= 0.0F) continue;
        const Cover before = shaft(ray, centre, a);
        if (before.share > 0.0F && before.depth < seen.depth) seen.share *= 1.0F - before.share;
        colour += seen.share * seen.colour;
        share += seen.share;
      }
      if (share > 0.0F)
        blend(image, u, v, colour / static_cast<float>(places), share / static_cast<float>(places));
    }
}

}  // namespace capstan::simulation
