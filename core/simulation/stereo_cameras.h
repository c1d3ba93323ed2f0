#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/random.h"
#include "core/simulation/renderer.h"
#include "core/simulation/truth.h"
#include "core/tracking/sample.h"
#include "core/vision/camera.h"
#include "core/vision/triangulation.h"

namespace capstan::simulation {

/// The plain truth of one StereoFrame or TipSample.
struct FrameTruth {
  double t = 0.0;                                    ///< true mid exposure [s]
  Eigen::Vector3d joints = Eigen::Vector3d::Zero();  ///< [rad, rad, m]
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();     ///< in frame 0 [m]
  std::array<RenderedMarker, 2> marker;              ///< left, right [px]
};

/// What the rig exposes at one instant.
struct Exposure {
  double t = 0.0;  ///< true mid exposure [s]
  Eigen::Vector3d joints;
  ToolPose tool;
  std::array<bool, 2> blocked{};  ///< left, right
  std::optional<ToolPose>
      displaced{};  ///< where the pictures show it, of cameras that mislead; absent: at `tool`
};

/// The rig: exposes at its own rate, stamps by its own clock, delivers after its latency, in order. Pictures
/// live in a fixed set of buffers; one that a consumer still holds is not drawn over.
class StereoCameras {
 public:
  /// `base_from_camera` is the true pose of the left camera.
  StereoCameras(const vision::StereoRig& rig, const Eigen::Isometry3d& base_from_camera,
                const SceneSizes& sizes, const Truth& truth, bool images, int buffers, std::uint64_t seed);

  /// True time of the next exposure [s].
  double nextExposure() const { return (static_cast<double>(exposures_) + 0.5) / timing_.rate; }
  /// Takes the exposure of nextExposure(); it is delivered when it arrives.
  void expose(const Exposure& exposure);
  /// The oldest frame that has arrived by `now` [s], as StereoFrame or, without images, as TipSample.
  bool deliver(double now, tracking::Sample& out);
  const FrameTruth& delivered() const { return delivered_; }

  /// Registration that turns triangulated points into TipSamples.
  void setRegistration(const Eigen::Isometry3d& base_from_camera) { registration_ = base_from_camera; }

  /// UKF paper (1) with this rig's own pictures (or noisy pixels) of a tool at rest at `tool`, searched as
  /// the pipeline searches: around the place where the `nominal` mounting, whose rotation is the known one,
  /// expects the marker, then everywhere. Throws base::InputError when the marker is found in less than half
  /// of the frames.
  Eigen::Isometry3d registerAtRest(const ToolPose& tool, const Eigen::Isometry3d& nominal,
                                   const Eigen::Vector3d& marker_in_base, int frames);

 private:
  struct Flight {
    double stamp = 0.0, arrival = 0.0;
    FrameTruth truth;
    cv::Mat left, right;       // with images
    Eigen::Vector3d measured;  // without: left camera's frame [m], NaN: not seen
  };
  using ImagePair = std::array<cv::Mat, 2>;

  ImagePair& freePair();
  Eigen::Vector3d triangulated(const FrameTruth& truth, const std::array<bool, 2>& blocked);
  double jitter(double sigma);

  CameraTruth timing_;
  bool images_;
  vision::Triangulator triangulator_;
  std::vector<CameraRenderer> renderers_;  // left, right
  std::vector<ImagePair> frames_;
  std::size_t next_frame_ = 0;
  std::vector<Flight> flights_;  // oldest first
  base::Random clock_, pixels_;
  std::int64_t exposures_ = 0;
  double last_stamp_ = -1.0, last_arrival_ = -1.0;
  Eigen::Isometry3d registration_ = Eigen::Isometry3d::Identity();
  FrameTruth delivered_;
};

}  // namespace capstan::simulation
