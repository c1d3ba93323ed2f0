#pragma once

#include <string>
#include <string_view>

#include "core/stats/running_rms.h"
#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Running RMS of one quantity's error per joint [rad, rad, m]: value(), count().
using JointRms = stats::RunningRms<3>;

/// RMS errors against the reference encoders; against the robot's own kinematics, differences. Errors of
/// kinematics and UKF are taken where a reference and a motor sample have the same time
/// (Snapshot::reference_paired); errors of the camera are taken at exposure, for each camera sample that the
/// filter accepted.
class ErrorTable {
 public:
  void add(const Snapshot& snapshot);

  const JointRms& kinematic() const { return kinematic_; }
  const JointRms& camera() const { return camera_; }
  const JointRms& ukf() const { return ukf_; }
  /// RMS error of the UKF while the newest camera sample is accepted; comparable with camera().
  const JointRms& ukfSeen() const { return ukf_seen_; }

  /// Table of the RMS errors in deg, deg, mm, for people: one row per joint, columns kinematic, camera, UKF.
  /// `head`: what the numbers are, up to nine characters.
  std::string text(std::string_view head = "RMS error") const;

 private:
  JointRms kinematic_, camera_, ukf_, ukf_seen_;
};

}  // namespace capstan::tracking
