#pragma once

#include <Eigen/Core>

#include "core/robot/arm_kinematics.h"
#include "core/robot/description.h"
#include "core/tracking/cable_arm_model.h"
#include "core/tracking/encoder_watch.h"
#include "core/tracking/motor_side.h"
#include "core/tracking/partial_kinematics.h"
#include "core/tracking/snapshot.h"

namespace capstan::tracking {

/// Snapshot before the first sample: quantities that do not exist are NaN.
Snapshot emptySnapshot();

/// Writes the state of motors and filter at one instant into a snapshot: q_m, q_kin, q_ukf with its sigma,
/// cable stretch and tension, tips. No allocation.
class EstimateView {
 public:
  /// `extended`: the filter's model of a robot with effects, else null; it must outlive the view.
  explicit EstimateView(const robot::Description& robot, const ExtendedArmModel* extended = nullptr);

  /// Writes the estimate into `snapshot`; `mean` and `covariance` are those of q1 dq1 q2 dq2 q3 dq3.
  void show(const CableArmModel::State& mean, const Eigen::Matrix<double, 6, 6>& covariance,
            const MotorSide& motors, const EncoderWatch& watch, Snapshot& snapshot);
  /// Sets the cable memory for the next show() (robots with effects).
  void setMemory(const CableMemory& memory) { memory_ = memory; }
  /// Sets the filter's motor correction for the next show().
  void setCorrection(const MotorCorrection& correction) { correction_ = correction; }
  /// Covariance of the joint positions in the last snapshot [rad², rad², m²].
  const Eigen::Matrix3d& positionCovariance() const { return position_covariance_; }

 private:
  void showCables(const MotorSide& motors, Snapshot& snapshot) const;
  void showUnknown(const MotorSide& motors, const EncoderWatch& watch, Snapshot& snapshot) const;

  robot::Description robot_;
  const ExtendedArmModel* extended_;
  CableMemory memory_;
  MotorCorrection correction_;
  robot::ArmKinematics arm_;
  PartialKinematics cables_;
  Eigen::Matrix3d position_covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace capstan::tracking
