#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"
#include "core/vision/camera.h"
#include "core/vision/camera_ray.h"
#include "core/vision/marker.h"
#include "core/vision/marker_detector.h"
#include "core/vision/triangulation.h"

namespace capstan::tracking {

/// Finds the marker in both images of a frame and triangulates it.
class StereoTip {
 public:
  /// `search_full_frame`: search the whole frame if the region of interest holds no marker.
  StereoTip(const vision::StereoRig& rig, const vision::MarkerOptions& marker, bool search_full_frame);

  /// Searches around the projections of `expected` [m, left camera's frame], or in the whole frame without
  /// it.
  void find(const StereoFrame& frame, const std::optional<Eigen::Vector3d>& expected);

  const std::array<vision::MarkerDetection, 2>& markers() const { return markers_; }
  /// kOpen when both images hold a marker, else the gate that names the lost one.
  Gate gate() const;
  /// Line of sight of one camera, whose marker must have been found.
  vision::CameraRay ray(int side) const;
  /// Position [m] and covariance [m²] in the left camera's frame. Both markers must have been found.
  vision::Triangulation triangulate() const;
  /// The same of the exchanged images: the left one as the right camera's, and the other way round.
  vision::Triangulation triangulateExchanged() const;

 private:
  vision::MarkerDetection findIn(const cv::Mat& image, const vision::Camera& camera,
                                 const std::optional<Eigen::Vector3d>& expected);

  vision::StereoRig rig_;
  vision::MarkerOptions options_;
  bool search_full_frame_;
  vision::MarkerDetector detector_;
  vision::Triangulator triangulator_;
  std::array<vision::MarkerDetection, 2> markers_;
};

}  // namespace capstan::tracking
