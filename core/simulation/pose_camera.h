#pragma once

#include <Eigen/Geometry>

#include "core/base/random.h"
#include "core/simulation/tool_truth.h"

namespace capstan::simulation {

/// A pose measured by motion capture; position 0 and identity rotation where it saw none.
struct PoseObservation {
  double t = 0.0;  ///< stamp [s]
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  bool observed = false;
};

/// Motion capture of the lights on a tool:
///     registration · pose · mounting · noise,
/// stamped late. Now and then a light hides and for a while the pose is another, off by a jump; or there is
/// none.
class PoseCamera {
 public:
  PoseCamera(const PoseCameraTruth& truth, std::uint64_t seed);

  /// The tool's pose (frame 0) at `t` [s]; called once a sample, in the order of time.
  PoseObservation see(double t, const Eigen::Isometry3d& pose);

  /// Cameras' base frame from frame 0.
  const Eigen::Isometry3d& registration() const { return registration_; }
  /// Frame of the tool from that of its lights.
  const Eigen::Isometry3d& mounting() const { return mounting_; }

 private:
  Eigen::Vector3d drawn(double sigma);

  PoseCameraTruth truth_;
  base::Random random_;
  Eigen::Isometry3d registration_, mounting_, jump_;
  double jump_left_ = 0.0;  ///< [s]
};

}  // namespace capstan::simulation
