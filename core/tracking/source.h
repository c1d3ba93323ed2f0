#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/description.h"
#include "core/tracking/sample.h"
#include "core/vision/camera.h"

namespace capstan::tracking {

/// Information that a source has before its first sample.
struct SourceInfo {
  std::string title;                     ///< for the window's title and reports
  robot::Description robot;              ///< nominal robot, known to the estimator
  std::optional<vision::StereoRig> rig;  ///< present with images only
  /// Registration stored with the recording. For images without a stored registration the user registers
  /// first.
  std::optional<Eigen::Isometry3d> base_from_camera;
  std::string truth;       ///< truth file text of a simulation, else empty
  std::string marker;      ///< marker options (YAML) stored with the recording, else empty
  std::string tracking;    ///< tracking options (YAML) stored with the recording, else empty
  double begin = 0.0;      ///< time of the first sample [s]
  double duration = 0.0;   ///< from the first sample to the last [s]; 0: unknown (live)
  bool reference = false;  ///< the robot has joint encoders
  /// True if the joint encoder columns hold the robot's own transmission kinematics, which is no truth.
  bool own_kinematics = false;
  bool live = false;                 ///< the robot can be commanded (simulated or real)
  std::vector<std::string> notices;  ///< exclusions and remarks for the user, one per line
};

/// Yields samples in order of arrival. Deterministic sources yield the same bytes each time.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  /// Writes the next sample to `out`, whose images are reused. False: the source has ended.
  virtual bool next(tracking::Sample& out) = 0;
  /// Blocks (true) or unblocks the view of each camera from now on. Images then show the occlusion in their
  /// pixels.
  virtual void block(bool left, bool right) = 0;
};

}  // namespace capstan::tracking
