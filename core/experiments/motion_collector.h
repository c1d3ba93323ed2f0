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

/// Rounded values: times to 1e-6 s, joints to 1e-9 rad or m. The division gives short decimals.
double roundedTime(double t);
Eigen::Vector3d rounded(const Eigen::Vector3d& joints);

/// Collects the motion of a trial from the snapshots of its pipeline: trajectory points at kRate, and every
/// camera sample that the filter accepted. With a reference, points are taken where it coincides with a motor
/// sample.
class MotionCollector {
 public:
  static constexpr double kRate = 20.0;  ///< rate of trajectory points [1/s]

  /// `source` and `motion` must outlive the collector.
  MotionCollector(const TrialSource& source, TrialMotion& motion);

  /// Takes every snapshot, in order.
  void take(const tracking::Snapshot& snapshot);
  /// Sets begin, end and occluded share of the motion.
  void finish();
  /// Joints by transmission kinematics of the nominal robot [rad, rad, m].
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

/// Collects the trajectory of a running session or a recording, with kinematics of the robot in use. Points
/// come at most at kRate, where a reference coincides with a motor sample (without `reference`: at motor
/// samples). `occluded` is that of ErrorCollector. Another thread may read it. Its memory is fixed: at
/// `capacity` points, every second point is dropped and the rate is halved.
class SessionMotion {
 public:
  static constexpr double kRate = MotionCollector::kRate;
  static constexpr std::size_t kCapacity = std::size_t{1} << 15;  ///< 27 min at kRate

  explicit SessionMotion(std::size_t capacity = kCapacity, bool reference = true);

  /// Takes every snapshot, in order. Allocates nothing up to kCapacity points.
  void take(const tracking::Snapshot& snapshot);
  /// Deletes all points.
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
