#include "core/tracking/stereo_tip.h"

#include <algorithm>

namespace capstan::tracking {
StereoTip::StereoTip(const vision::StereoRig& rig, const vision::MarkerOptions& marker,
                     bool search_full_frame)
    : rig_(rig),
      options_(marker),
      search_full_frame_(search_full_frame),
      detector_(marker, std::max(rig.left.width, rig.right.width),
                std::max(rig.left.height, rig.right.height)),
      triangulator_(rig) {}

vision::MarkerDetection StereoTip::findIn(const cv::Mat& image, const vision::Camera& camera,
                                          const std::optional<Eigen::Vector3d>& expected) {
  if (image.empty()) return {};
  if (image.cols != camera.width || image.rows != camera.height) {
    vision::MarkerDetection refused;
    refused.fault = vision::MarkerFault::kWrongImage;
    return refused;
  }
  const auto pixel = expected ? camera.project(*expected) : std::nullopt;
  if (!pixel) return detector_.detect(image);
  const cv::Rect roi = vision::roiAround(*pixel, options_, image.size());
  if (roi.empty()) return search_full_frame_ ? detector_.detect(image) : detector_.detect(image, roi);
  vision::MarkerDetection marker = detector_.detect(image, roi);
  if (!marker.found() && search_full_frame_) marker = detector_.detect(image);
  return marker;
}

void StereoTip::find(const StereoFrame& frame, const std::optional<Eigen::Vector3d>& expected) {
  std::optional<Eigen::Vector3d> expected_right;
  if (expected) expected_right = rig_.right_from_left * *expected;
  markers_[0] = findIn(frame.left, rig_.left, expected);
  markers_[1] = findIn(frame.right, rig_.right, expected_right);
}

Gate StereoTip::gate() const {
  if (markers_[0].found()) return markers_[1].found() ? Gate::kOpen : Gate::kRightLost;
  return markers_[1].found() ? Gate::kLeftLost : Gate::kBothLost;
}

vision::CameraRay StereoTip::ray(int side) const {
  return vision::rayThrough(rig_, side, markers_[static_cast<std::size_t>(side)]);
}

vision::Triangulation StereoTip::triangulate() const {
  return triangulator_.triangulate(markers_[0].centroid, markers_[1].centroid, markers_[0].sigma,
                                   markers_[1].sigma);
}

vision::Triangulation StereoTip::triangulateExchanged() const {
  return triangulator_.triangulate(markers_[1].centroid, markers_[0].centroid, markers_[1].sigma,
                                   markers_[0].sigma);
}

}  // namespace capstan::tracking
