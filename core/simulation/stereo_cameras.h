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

/// True values behind one StereoFrame or TipSample.
struct FrameTruth {
  double t = 0.0;                                    ///< true mid exposure [s]
  Eigen::Vector3d joints = Eigen::Vector3d::Zero();  ///< [rad, rad, m]
  Eigen::Vector3d tip = Eigen::Vector3d::Zero();     ///< tip position in frame 0 [m]
  std::array<RenderedMarker, 2> marker;              ///< left, right [px]
};

/// Scene of one exposure.
struct Exposure {
  double t = 0.0;  ///< true mid exposure [s]
  Eigen::Vector3d joints;
  ToolPose tool;
  std::array<bool, 2> blocked{};  ///< true: the camera is blocked; left, right
  std::optional<ToolPose>
      displaced{};  ///< pose of the tool in the images of cameras with errors; absent: `tool`
};

/// Simulated stereo rig. It exposes at its own rate, stamps by its own clock and delivers frames after its
/// latency, in order. Images are kept in a fixed set of buffers; a buffer that a consumer still holds is not
/// overwritten.
class StereoCameras {
 public:
  /// `base_from_camera` is the true pose of the left camera.
  StereoCameras(const vision::StereoRig& rig, const Eigen::Isometry3d& base_from_camera,
                const SceneSizes& sizes, const Truth& truth, bool images, int buffers, std::uint64_t seed);

  /// True time of the next exposure [s].
  double nextExposure() const { return (static_cast<double>(exposures_) + 0.5) / timing_.rate; }
  /// Makes the exposure at nextExposure(); deliver() returns its frame once it has arrived.
  void expose(const Exposure& exposure);
  /// Writes the oldest frame that has arrived by `now` [s] to `out`, as StereoFrame or, without images, as
  /// TipSample. Returns false when none has.
  bool deliver(double now, tracking::Sample& out);
  const FrameTruth& delivered() const { return delivered_; }  ///< truth of the frame delivered last

  /// Sets the registration that transforms triangulated points to frame 0 for TipSamples.
  void setRegistration(const Eigen::Isometry3d& base_from_camera) { registration_ = base_from_camera; }

  /// Registration by UKF paper (1) from this rig's images (or noisy pixels) of a tool at rest at `tool`. The
  /// search is that of the pipeline: first around the marker position that the `nominal` mounting predicts
  /// (its rotation is the known one), then in the whole image. Throws base::InputError when the marker is
  /// found in less than half of the frames.
  Eigen::Isometry3d registerAtRest(const ToolPose& tool, const Eigen::Isometry3d& nominal,
                                   const Eigen::Vector3d& marker_in_base, int frames);

 private:
  struct Flight {
    double stamp = 0.0, arrival = 0.0;
    FrameTruth truth;
    cv::Mat left, right;  // with images
    std::array<bool, 2> blocked{};
    Eigen::Vector3d measured;  // without images: tip in the left camera's frame [m]; NaN: not observed
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
