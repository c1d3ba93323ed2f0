#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "core/robot/description.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/options.h"
#include "core/tracking/sample.h"
#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Largest motor movement that counts as standing still [rad]: 1.25 encoder counts.
double stillWithin(const robot::Drive& drive);

/// Detects failed motor encoders.
///
/// Lost: the sample holds no finite position. For up to `lost_after` seconds this is a gap, and the encoder
/// is used again after it. After a longer time counts may have been missed, and the encoder stays failed.
///
/// Frozen: the count stands still while the camera sees the link side of the cable, (A q)_j, move. Motor j is
/// declared frozen when all of these hold in `jump_samples` successive camera samples since its count last
/// changed: the marker moved on a continuous path (so it is the same object); (A q_cam)_j differs from its
/// value at the first of these samples by more than its noise plus `frozen_tolerance` (the largest cable
/// stretch); and every cable whose motor is not a candidate agrees with its motor within `jump_tolerance`. If
/// motor and joints are both at rest, there is no fault. While no motor samples come nothing is known of the
/// counts, so that nobody is accused; they are watched anew from the first sample after such a silence.
///
/// Failed encoders stay failed until declare(motor, false) or clear(). No allocation.
class EncoderWatch {
 public:
  EncoderWatch(const robot::Description& robot, const TrackingOptions& options);

  /// Forgets detected faults and all samples; declared faults stay.
  void clear();
  /// Starts a new time line: forgets earlier samples but no faults.
  void restart();

  /// Returns `sample` with each position that is not finite replaced by the last known one (before the first:
  /// that of joints in the middle of their ranges) and velocity 0. Returns nothing when the sample's time is
  /// not finite, or when all positions are not finite and there was no sample in the last `restart_gap`
  /// seconds.
  std::optional<MotorSample> take(const MotorSample& sample);

  /// Takes the camera observation q_cam at t [rad, rad, m], its covariance and q_kin at that time. Returns
  /// the motors that this sample shows to be frozen.
  JointSet see(double t, const Eigen::Vector3d& q_cam, const Eigen::Matrix3d& covariance,
               const Eigen::Vector3d& q_kin);

  void declare(int motor, bool failed);
  /// Motors whose encoder is not used at the newest sample: failed encoders and encoders in a gap.
  JointSet unknown() const { return failed_ | gap_; }
  const std::array<MotorFault, 3>& faults() const { return faults_; }
  /// Time at which the count of a motor last changed [s].
  double stillSince(int motor) const { return still_[static_cast<std::size_t>(motor)].since; }

 private:
  struct Still {
    bool valid = false;
    double position = 0.0;  ///< q_m [rad]
    double since = 0.0;     ///< [s]
    bool seen = false;
    double link = 0.0, variance = 0.0;  ///< at the first camera sample after `since`
    int run = 0;
  };
  struct Seen {
    bool valid = false;
    double t = 0.0;
    Eigen::Vector3d q = Eigen::Vector3d::Zero(), variance = Eigen::Vector3d::Zero();
  };
  void fail(int motor, MotorFault fault);
  void watchStill(int motor, double t, double position);
  bool isContinuous(const Seen& now) const;

  Eigen::Matrix3d coupling_;
  Eigen::Vector3d held_;          ///< last known q_m [rad]
  Eigen::Vector3d still_within_;  ///< [rad]
  Eigen::Vector3d tolerance_, believable_, speed_;
  bool detect_;
  double lost_after_, restart_gap_, longest_gap_;
  double known_for_;  ///< time after a motor sample for which its counts are known [s]
  int samples_;
  std::array<MotorFault, 3> faults_{};
  JointSet failed_ = 0, gap_ = 0;
  std::array<double, 3> gap_since_{};
  std::array<Still, 3> still_;
  Seen seen_;
  std::optional<double> newest_;
};

}  // namespace capstan::tracking
