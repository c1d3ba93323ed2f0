#pragma once

#include <cstdint>

#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"
#include "core/robot/transmission.h"
#include "core/session/due_times.h"
#include "core/tracking/snapshot.h"

namespace capstan::experiments {

/// To 1e-6 s, and to 1e-9 rad or m by division, so that the decimals are short.
double roundedTime(double t);
Eigen::Vector3d rounded(const Eigen::Vector3d& joints);

/// Listens to a trial's pipeline and keeps its motion: the trajectory 20 times a second, where a reference
/// meets a motor sample if there are references, and every camera sample that the filter took.
class MotionCollector {
 public:
  static constexpr double kRate = 20.0;  ///< [1/s]

  /// Both outlive the collector.
  MotionCollector(const TrialSource& source, TrialMotion& motion);

  /// Every snapshot, in order.
  void take(const tracking::Snapshot& snapshot);
  /// Counts what is known at the end: begin, end, occluded share.
  void finish();
  /// Transmission kinematics of the nominal robot [rad, rad, m].
  Eigen::Vector3d kinematicOf(const tracking::Snapshot& snapshot) const {
    return nominal_.jointFromMotor(snapshot.q_motor);
  }

 private:
  void takeCamera(const tracking::Snapshot& snapshot);
  void takePoint(const tracking::Snapshot& snapshot);

  const TrialSource& source_;
  TrialMotion& motion_;
  robot::Transmission nominal_;
  bool reference_;
  session::DueTimes due_{kRate};
  Eigen::Vector3d seen_ = noJoints();
  std::uint64_t samples_ = 0, blocked_ = 0;
};

}  // namespace capstan::experiments
