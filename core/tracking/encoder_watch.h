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

/// A motor that has moved by less stands still [rad]: a count of its encoder and a quarter.
double stillWithin(const robot::Drive& drive);

/// Detects failed motor encoders.
///
/// Lost: the sample holds no finite position. Up to `lost_after` seconds that is a gap, and the encoder is
/// used again behind it; for longer, counts may have been missed and it stays failed.
///
/// Frozen: the count stands still while the camera sees the cable's link side, (A q)_j, move. Motor j is
/// declared frozen when, in `jump_samples` successive camera samples since its count last changed, all of
/// these hold: the marker moved on a continuous path (so it is the same object); (A q_cam)_j differs from its
/// value at the first of these samples by more than its noise plus `frozen_tolerance` (the largest cable
/// stretch); and every cable whose motor is not suspected itself agrees with that motor within
/// `jump_tolerance`. A motor and joints that are both at rest are no fault.
///
/// Failed encoders stay failed until declare(motor, false) or clear(). No allocation.
class EncoderWatch {
 public:
  EncoderWatch(const robot::Description& robot, const TrackingOptions& options);

  /// Forgets what was detected and every sample; what was declared stays.
  void clear();
  /// A new time line: forgets what it was comparing with, not the faults.
  void restart();

  /// `sample` with the last known position (at first: what holds the joint in the middle of its range), at
  /// rest, in place of what is not finite. Nothing when the sample is of no use: time or all positions not
  /// finite, the latter with no sample in the last `restart_gap` seconds, so that its time means nothing.
  std::optional<MotorSample> take(const MotorSample& sample);

  /// What the camera saw at t [rad, rad, m], with its covariance and q_kin of that time. The motors, if any,
  /// that are now known to be frozen.
  JointSet see(double t, const Eigen::Vector3d& q_cam, const Eigen::Matrix3d& covariance,
               const Eigen::Vector3d& q_kin);

  void declare(int motor, bool failed);
  /// Motors whose encoder is not used at the newest sample: those failed and those in a gap.
  JointSet unknown() const { return failed_ | gap_; }
  const std::array<MotorFault, 3>& faults() const { return faults_; }
  /// When the count of a motor last changed [s].
  double stillSince(int motor) const { return still_[static_cast<std::size_t>(motor)].since; }

 private:
  struct Still {
    bool valid = false;
    double position = 0.0;  ///< q_m [rad]
    double since = 0.0;     ///< [s]
    bool seen = false;
    double link = 0.0, variance = 0.0;  ///< of the first camera sample behind `since`
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
  int samples_;
  std::array<MotorFault, 3> faults_{};
  JointSet failed_ = 0, gap_ = 0;
  std::array<double, 3> gap_since_{};
  std::array<Still, 3> still_;
  Seen seen_;
  std::optional<double> newest_;
};

}  // namespace capstan::tracking
