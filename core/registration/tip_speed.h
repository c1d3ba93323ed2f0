#pragma once

#include <Eigen/Core>
#include <limits>

#include "core/tracking/snapshot.h"

namespace capstan::registration {

/// Speed of the tip by transmission kinematics, from one snapshot to the next.
class TipSpeed {
 public:
  /// Longest time between two samples whose distance gives a speed [s].
  static constexpr double kLongestPair = 0.2;

  /// Speed since the snapshot before [m/s]; NaN for the first one and after more than kLongestPair.
  double to(const tracking::Snapshot& snapshot) {
    const double dt = snapshot.t_cam - last_t_;
    const double distance = (snapshot.tip_kin_cam - last_tip_).norm();
    last_t_ = snapshot.t_cam;
    last_tip_ = snapshot.tip_kin_cam;
    return dt > 0.0 && dt <= kLongestPair ? distance / dt : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double last_t_ = 0.0;
  Eigen::Vector3d last_tip_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

}  // namespace capstan::registration
