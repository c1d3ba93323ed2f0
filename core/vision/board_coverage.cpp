#include "core/vision/board_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace capstan::vision {

namespace {

constexpr double kRangeX = 0.7, kRangeY = 0.7, kRangeSize = 0.4, kRangeSkew = 0.5;

/// The board's outermost corners in the image, around it, by the homography from board to image: a board that
/// is seen in part has the shape of the part.
std::vector<cv::Point2f> outline(const std::vector<cv::Point3f>& points,
                                 const std::vector<cv::Point2f>& pixels) {
  std::vector<cv::Point2f> plane;
  for (const cv::Point3f& point : points) plane.emplace_back(point.x, point.y);
  const auto [x_low, x_high] =
      std::minmax_element(plane.begin(), plane.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [y_low, y_high] =
      std::minmax_element(plane.begin(), plane.end(), [](auto& a, auto& b) { return a.y < b.y; });
  const std::vector<cv::Point2f> box = {
      {x_low->x, y_low->y}, {x_high->x, y_low->y}, {x_high->x, y_high->y}, {x_low->x, y_high->y}};
  const cv::Mat homography = cv::findHomography(plane, pixels);
  std::vector<cv::Point2f> corners;
  if (!homography.empty()) cv::perspectiveTransform(box, corners, homography);
  return corners;
}

double range(const std::vector<ViewShape>& views, double ViewShape::*of) {
  const auto [low, high] = std::minmax_element(
      views.begin(), views.end(), [of](const ViewShape& a, const ViewShape& b) { return a.*of < b.*of; });
  return (*high).*of - (*low).*of;
}

}  // namespace

double ViewShape::distanceTo(const ViewShape& other) const {
  return std::abs(x - other.x) + std::abs(y - other.y) + std::abs(size - other.size) +
         std::abs(skew - other.skew);
}

ViewShape shapeOf(const std::vector<cv::Point3f>& points, const std::vector<cv::Point2f>& pixels,
                  const cv::Size& size) {
  const std::vector<cv::Point2f> corners = outline(points, pixels);
  ViewShape shape;
  if (corners.size() != 4) return shape;
  const cv::Scalar middle = cv::mean(pixels);
  const cv::Point2f up = corners[0] - corners[1], down = corners[2] - corners[1];
  const double cosine = up.dot(down) / std::max(1e-12, cv::norm(up) * cv::norm(down));
  const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
  shape.x = std::clamp(middle[0] / size.width, 0.0, 1.0);
  shape.y = std::clamp(middle[1] / size.height, 0.0, 1.0);
  shape.size = std::clamp(std::sqrt(std::abs(cv::contourArea(corners)) / size.area()), 0.0, 1.0);
  shape.skew = std::min(1.0, 2.0 * std::abs(0.5 * std::numbers::pi - angle));
  return shape;
}

BoardCoverage coverageOf(const std::vector<ViewShape>& views) {
  if (views.empty()) return {};
  const auto largest = [&](double ViewShape::*of) {
    double most = 0.0;
    for (const ViewShape& view : views) most = std::max(most, view.*of);
    return most;
  };
  return {std::min(1.0, range(views, &ViewShape::x) / kRangeX),
          std::min(1.0, range(views, &ViewShape::y) / kRangeY),
          std::min(1.0, largest(&ViewShape::size) / kRangeSize),
          std::min(1.0, largest(&ViewShape::skew) / kRangeSkew)};
}

}  // namespace capstan::vision
