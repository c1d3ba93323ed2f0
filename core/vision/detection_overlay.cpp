#include "core/vision/detection_overlay.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/base/error.h"

namespace capstan::vision {
namespace {

constexpr int kInset = 160, kEnlarged = 8, kSubpixelBits = 4, kMargin = 12;
const cv::Scalar kCircle(255, 255, 0), kCross(255, 255, 255), kText(0, 200, 255);

// Position in drawing functions that take fractions of a pixel as integers.
cv::Point fine(const Eigen::Vector2d& pixel) {
  constexpr double kScale = 1 << kSubpixelBits;
  return {cvRound(kScale * pixel.x()), cvRound(kScale * pixel.y())};
}

void drawMarker(cv::Mat& picture, const Eigen::Vector2d& centre, double radius) {
  cv::circle(picture, fine(centre), cvRound(radius * (1 << kSubpixelBits)), kCircle, 1, cv::LINE_AA,
             kSubpixelBits);
  for (const Eigen::Vector2d& arm : {Eigen::Vector2d(0.3 * radius, 0.0), Eigen::Vector2d(0.0, 0.3 * radius)})
    cv::line(picture, fine(centre - arm), fine(centre + arm), kCross, 1, cv::LINE_AA, kSubpixelBits);
}

// The surroundings of the marker, enlarged by the ratio of kInset to `side`.
cv::Mat enlarged(const cv::Mat& picture, const MarkerDetection& marker) {
  const int side = std::max(kInset / kEnlarged, cvRound(3.0 * marker.radius));
  cv::Mat patch, inset;
  cv::getRectSubPix(picture, {side, side},
                    {static_cast<float>(marker.centroid.x()), static_cast<float>(marker.centroid.y())},
                    patch);
  cv::resize(patch, inset, {kInset, kInset}, 0.0, 0.0, cv::INTER_NEAREST);
  const double scale = static_cast<double>(kInset) / side;
  // resize() maps the centre of the patch to the centre of the inset, both between pixels.
  drawMarker(inset, Eigen::Vector2d::Constant(0.5 * kInset - 0.5), scale * marker.radius);
  return inset;
}

// The name of the side in the lower corner, and the reason why there is no marker, over a dark outline.
void drawWords(cv::Mat& picture, const std::string& words) {
  const cv::Point at(kMargin, picture.rows - kMargin);
  for (const auto& [ink, width] : {std::pair{cv::Scalar(0, 0, 0), 4}, std::pair{kText, 1}})
    cv::putText(picture, words, at, cv::FONT_HERSHEY_SIMPLEX, 0.6, ink, width, cv::LINE_AA);
}

cv::Mat drawn(const cv::Mat& picture, const MarkerDetection& marker, const std::string& side) {
  cv::Mat result = picture.clone();
  drawWords(result, marker.found() ? side : side + ": " + std::string(base::nameOf(marker.fault)));
  if (!marker.found()) return result;
  drawMarker(result, marker.centroid, marker.radius);
  if (result.cols < 2 * kInset || result.rows < 2 * kInset) return result;
  const bool left = marker.centroid.x() > 0.5 * result.cols;  // the corner away from the marker
  const cv::Rect place(left ? 0 : result.cols - kInset, 0, kInset, kInset);
  enlarged(picture, marker).copyTo(result(place));
  cv::rectangle(result, place, kCross);
  return result;
}

}  // namespace

cv::Mat detectionOverlay(const std::array<cv::Mat, 2>& pictures,
                         const std::array<MarkerDetection, 2>& markers) {
  std::array<cv::Mat, 2> sides = {drawn(pictures[0], markers[0], "left"),
                                  drawn(pictures[1], markers[1], "right")};
  const int rows = std::max(sides[0].rows, sides[1].rows);
  for (cv::Mat& side : sides) cv::copyMakeBorder(side, side, 0, rows - side.rows, 0, 0, cv::BORDER_CONSTANT);
  cv::Mat both;
  cv::hconcat(sides[0], sides[1], both);
  return both;
}

void writePicture(const cv::Mat& picture, const std::filesystem::path& path) {
  bool written = false;
  try {
    written = cv::imwrite(path.string(), picture);
  } catch (const cv::Exception&) {
  }
  if (!written)
    throw base::InputError(
        {path.string(), 0, {}, {}, "cannot be written", "Give a folder in which files may be made"});
}

}  // namespace capstan::vision
