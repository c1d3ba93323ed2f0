#include "app/monitor/eye_overlay.h"

#include <algorithm>
#include <cmath>

namespace capstan::monitor {

namespace {

/// From pixels of the camera's image to those of the window.
class Map {
 public:
  Map(const Rect& rect, const cv::Size& image)
      : rect_(rect),
        scale_x_(static_cast<float>(rect.width) / static_cast<float>(image.width)),
        scale_y_(static_cast<float>(rect.height) / static_cast<float>(image.height)) {}

  Point at(double x, double y) const {
    return {static_cast<float>(rect_.x) + scale_x_ * static_cast<float>(x + 0.5),
            static_cast<float>(rect_.y) + scale_y_ * static_cast<float>(y + 0.5)};
  }
  /// Border of an ellipse of the image; where the image is stretched, of the stretched one.
  std::vector<Point> ellipse(double x, double y, double a, double b, double angle) const {
    auto border = ellipseBorder({static_cast<float>(x), static_cast<float>(y)}, static_cast<float>(a),
                                static_cast<float>(b), static_cast<float>(angle));
    for (Point& point : border) point = at(point.x, point.y);
    return border;
  }

 private:
  Rect rect_;
  float scale_x_, scale_y_;
};

/// Four strokes that point at the tip from outside its marker.
void sketchReticle(Sketch& sketch, const Map& map, const std::array<double, 3>& tip, float width,
                   const Colour& colour) {
  const double inner = 1.35 * tip[2] + 2.0, outer = 2.4 * tip[2] + 6.0;
  for (const auto& [x, y] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
    const std::array<Point, 2> stroke = {map.at(tip[0] + x * inner, tip[1] + y * inner),
                                         map.at(tip[0] + x * outer, tip[1] + y * outer)};
    sketch.haloed(stroke, 1.3F * width, colour);
  }
}

/// The shaft, which ends at the circle of the marker so that the 2 sigma ellipse inside stays visible.
std::vector<Point> shaftUpToMarker(const live::FeedEye& eye, const Map& map) {
  std::vector<Point> shaft;
  const auto fromTip = [&eye](const std::array<double, 2>& point) {
    return std::hypot(point[0] - eye.tip[0], point[1] - eye.tip[1]);
  };
  for (int i = 0; i < eye.shaft_points; ++i) {
    const auto& point = eye.shaft[static_cast<std::size_t>(i)];
    if (eye.tip_found && fromTip(point) < eye.tip[2]) {
      if (i == 0) return {};
      const auto& before = eye.shaft[static_cast<std::size_t>(i - 1)];
      const double scale = eye.tip[2] / fromTip(before);
      shaft.push_back(map.at(eye.tip[0] + scale * (before[0] - eye.tip[0]),
                             eye.tip[1] + scale * (before[1] - eye.tip[1])));
      break;
    }
    shaft.push_back(map.at(point[0], point[1]));
  }
  return shaft;
}

}  // namespace

void sketchEye(Sketch& sketch, const live::FeedEye& eye, const Banner& banner, const Rect& rect,
               const cv::Size& image) {
  if (image.empty() || rect.empty()) return;
  const Map map(rect, image);
  const float width = std::max(2.0F, static_cast<float>(rect.height) / 160.0F);
  const float dash = banner.certain ? 0.0F : 5.0F * width;
  sketch.haloed(shaftUpToMarker(eye, map), width, banner.estimate, false, dash);
  if (eye.marker_found)
    sketch.haloed(map.ellipse(eye.circle[0], eye.circle[1], eye.circle[2], eye.circle[2], 0.0), width,
                  kCamera, true);
  if (!eye.tip_found) return;
  const auto& tip = eye.tip;
  if (!banner.certain) {
    const auto border = map.ellipse(tip[0], tip[1], eye.ellipse[0], eye.ellipse[1], eye.ellipse[2]);
    sketch.disc(border, banner.estimate.faded(0.3F));
    sketch.line(border, 0.5F * width, banner.estimate, true);
    sketch.haloed(map.ellipse(tip[0], tip[1], tip[2], tip[2], 0.0), 0.6F * width, banner.estimate, true,
                  0.6F * dash);
  }
  sketchReticle(sketch, map, tip, width, banner.estimate);
}

}  // namespace capstan::monitor
