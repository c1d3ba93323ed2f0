#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/base/due_times.h"
#include "core/experiments/results.h"
#include "core/experiments/trial_setup.h"
#include "core/robot/transmission.h"
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
  base::DueTimes due_{kRate};
  Eigen::Vector3d seen_ = noJoints();
  std::uint64_t samples_ = 0, blocked_ = 0;
};

/// Gathers the trajectory of a running session or a recording, at most kRate times a second where a reference
/// meets a motor sample (without `reference`: at motor samples), kinematics of the robot in use. `occluded`
/// as in ErrorCollector. May be read from another thread. Its memory is fixed: when `capacity` points are
/// held, every other goes and the rate is halved.
class SessionMotion {
 public:
  static constexpr double kRate = MotionCollector::kRate;
  static constexpr std::size_t kCapacity = std::size_t{1} << 15;  ///< 27 min at kRate

  explicit SessionMotion(std::size_t capacity = kCapacity, bool reference = true);

  /// Every snapshot, in order. Allocates nothing up to kCapacity points.
  void take(const tracking::Snapshot& snapshot);
  /// Forgets everything.
  void restart();
  std::vector<TrajectoryPoint> trajectory() const;

 private:
  const std::size_t capacity_;
  const bool reference_;
  mutable std::mutex mutex_;
  double rate_ = kRate;
  base::DueTimes due_{kRate};
  std::vector<TrajectoryPoint> points_;
  Eigen::Vector3d seen_ = noJoints();
};

}  // namespace capstan::experiments
