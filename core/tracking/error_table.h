#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Running RMS of one source's error per joint [rad, rad, m], in the order of arrival (so that every user of
/// the same samples gets the same bits).
class RunningRms {
 public:
  /// Adds `error` unless a component is NaN.
  void add(const Eigen::Vector3d& error);
  Eigen::Vector3d rms() const;  ///< NaN before the first sample
  std::uint64_t count() const { return count_; }

 private:
  Eigen::Vector3d sum_of_squares_ = Eigen::Vector3d::Zero();
  std::uint64_t count_ = 0;
};

/// Errors against the reference encoders: kinematics and UKF where a reference and a motor sample of one time
/// meet (Snapshot::reference_paired), the camera at its own time of exposure, wherever the filter accepted
/// it.
class ErrorTable {
 public:
  void add(const Snapshot& snapshot);
  void clear() { *this = ErrorTable(); }

  const RunningRms& kinematic() const { return kinematic_; }
  const RunningRms& camera() const { return camera_; }
  const RunningRms& ukf() const { return ukf_; }

  /// For people: RMS in deg, deg, mm; one row a joint, columns kinematic, camera, UKF.
  std::string text() const;

 private:
  RunningRms kinematic_, camera_, ukf_;
};

}  // namespace capstan::tracking
