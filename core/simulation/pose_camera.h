#pragma once

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/simulation/tool_truth.h"

namespace capstan::simulation {

/// A tool pose measured by motion capture. Where none was observed: position 0 and identity rotation.
struct PoseObservation {
  double t = 0.0;  ///< time stamp [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  bool observed = false;
};

/// Simulated motion capture of the lights on a tool. It measures
///     registration · pose · mounting · noise
/// and stamps the pose late. At random times a light is hidden: for a while the pose has a constant error,
/// the jump. Some samples have no pose.
class PoseCamera {
 public:
  PoseCamera(const PoseCameraTruth& truth, std::uint64_t seed);

  /// Measures the tool's `pose` (frame 0) at `t` [s]. Call it once per sample, in order of time.
  PoseObservation see(double t, const Eigen::Isometry3d& pose);

  /// Transform from frame 0 to the cameras' base frame.
  const Eigen::Isometry3d& registration() const { return registration_; }
  /// Transform from the frame of the lights to the frame of the tool.
  const Eigen::Isometry3d& mounting() const { return mounting_; }

 private:
  Eigen::Vector3d drawn(double sigma);

  PoseCameraTruth truth_;
  base::Random random_;
  Eigen::Isometry3d registration_, mounting_, jump_;
  double jump_left_ = 0.0;  ///< time until the jump ends [s]
};

}  // namespace capstan::simulation
