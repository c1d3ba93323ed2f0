#pragma once

#include <Eigen/Geometry>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/yaml.h"
#include "core/recording/session_file.h"
#include "core/tracking/pipeline.h"
#include "core/tracking/source.h"
#include "core/vision/image_correction.h"
#include "core/vision/marker.h"

namespace capstan::live {

/// Robot, cameras, registration, marker and filter options that a session uses now. Any thread may call it.
class InUse {
 public:
  InUse(tracking::SourceInfo info, const tracking::TrackingPipeline& pipeline)
      : info_(std::move(info)), options_(pipeline.options()) {
    info_.robot = pipeline.robot();
    info_.base_from_camera = pipeline.registration();
  }

  void setRegistration(const Eigen::Isometry3d& base_from_camera) {
    const std::lock_guard lock(mutex_);
    info_.base_from_camera = base_from_camera;
  }
  void setMarker(const std::string& yaml) {
    const std::lock_guard lock(mutex_);
    info_.marker = yaml;
  }
  void setRobot(const robot::Description& robot) {
    const std::lock_guard lock(mutex_);
    info_.robot = robot;
  }
  void setImages(const vision::ImageCorrection& images) {
    const std::lock_guard lock(mutex_);
    images_ = images;
  }
  vision::ImageCorrection images() const {
    const std::lock_guard lock(mutex_);
    return images_;
  }
  void setRig(const vision::StereoRig& rig) {
    const std::lock_guard lock(mutex_);
    info_.rig = rig;
  }
  void setTracking(const tracking::TrackingOptions& options) {
    const std::lock_guard lock(mutex_);
    options_ = options;
    info_.tracking = base::writeYaml(options);
  }

  tracking::SourceInfo info() const {
    const std::lock_guard lock(mutex_);
    return info_;
  }
  robot::Description robot() const {
    const std::lock_guard lock(mutex_);
    return info_.robot;
  }
  tracking::TrackingOptions tracking() const {
    const std::lock_guard lock(mutex_);
    return options_;
  }
  vision::MarkerOptions marker() const {
    const std::string text = info().marker;
    return text.empty() ? vision::MarkerOptions{}
                        : base::readYaml<vision::MarkerOptions>(text, "marker options");
  }

  /// `header` with all of this.
  recording::SessionHeader of(recording::SessionHeader header) const {
    const std::lock_guard lock(mutex_);
    if (info_.base_from_camera) header.base_from_camera = info_.base_from_camera;
    if (info_.rig) {
      const auto cameras = vision::formatStereoRig(*info_.rig);
      header.camera_left = cameras[0], header.camera_right = cameras[1];
    }
    header.marker = info_.marker;
    header.robot = base::writeYaml(info_.robot);
    header.tracking = info_.tracking.empty() ? base::writeYaml(options_) : info_.tracking;
    return header;
  }

 private:
  mutable std::mutex mutex_;
  tracking::SourceInfo info_;
  tracking::TrackingOptions options_;
  vision::ImageCorrection images_;
};

}  // namespace capstan::live
