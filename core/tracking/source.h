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

/// What a source knows before its first sample.
struct SourceInfo {
  std::string title;                     ///< for the window's title and reports
  robot::Description robot;              ///< nominal: what the estimator may know
  std::optional<vision::StereoRig> rig;  ///< with images only
  /// Registration stored with the recording; with images and without it the user registers first.
  std::optional<Eigen::Isometry3d> base_from_camera;
  std::string truth;       ///< truth file text of a simulation, else empty
  std::string marker;      ///< marker options (YAML) stored with the recording, else empty
  std::string tracking;    ///< tracking options (YAML) stored with the recording, else empty
  double begin = 0.0;      ///< time of the first sample [s]
  double duration = 0.0;   ///< from the first sample to the last [s]; 0: unknown (live)
  bool reference = false;  ///< joint encoders fitted
  /// What stands in the place of joint encoders is the robot's own transmission kinematics: no truth.
  bool own_kinematics = false;
  bool live = false;                 ///< can be commanded (simulated or real robot)
  std::vector<std::string> notices;  ///< exclusions and remarks for the user, a line each
};

/// Yields samples in order of arrival. Deterministic sources yield the same bytes each time.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  /// The next sample into `out`, whose images are reused. False: the source has ended.
  virtual bool next(tracking::Sample& out) = 0;
  /// What cameras see is blocked from now on, with real pixels where there are images.
  virtual void block(bool left, bool right) = 0;
};

}  // namespace capstan::tracking
