#pragma once

#include <string>

#include "core/stats/running_rms.h"
#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Running RMS of one quantity's error per joint [rad, rad, m]: value(), count().
using JointRms = stats::RunningRms<3>;

/// Errors against the reference encoders: kinematics and UKF where a reference and a motor sample of one time
/// meet (Snapshot::reference_paired), the camera at its own time of exposure, wherever the filter accepted
/// it.
class ErrorTable {
 public:
  void add(const Snapshot& snapshot);

  const JointRms& kinematic() const { return kinematic_; }
  const JointRms& camera() const { return camera_; }
  const JointRms& ukf() const { return ukf_; }
  /// The UKF's where the filter accepted the newest camera sample: to be compared with camera().
  const JointRms& ukfSeen() const { return ukf_seen_; }

  /// For people: RMS in deg, deg, mm; one row a joint, columns kinematic, camera, UKF.
  std::string text() const;

 private:
  JointRms kinematic_, camera_, ukf_, ukf_seen_;
};

}  // namespace capstan::tracking
