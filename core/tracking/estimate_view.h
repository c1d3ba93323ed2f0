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

/// A snapshot before the first sample: what does not exist is NaN.
Snapshot emptySnapshot();

/// Writes what motors and filter say at one instant into a snapshot: q_m, q_kin, q_ukf with its sigma, cable
/// stretch and tension, tips. No allocation.
class EstimateView {
 public:
  /// `extended`: the filter's model of a robot with effects, else null; outlives the view.
  explicit EstimateView(const robot::Description& robot, const ExtendedArmModel* extended = nullptr);

  /// `mean` and `covariance` of q1 dq1 q2 dq2 q3 dq3.
  void show(const CableArmModel::State& mean, const Eigen::Matrix<double, 6, 6>& covariance,
            const MotorSide& motors, const EncoderWatch& watch, Snapshot& snapshot);
  /// What the cables of a robot with effects remember at that instant.
  void setMemory(const CableMemory& memory) { memory_ = memory; }
  /// What the filter makes of the motors at that instant.
  void setCorrection(const MotorCorrection& correction) { correction_ = correction; }
  /// Of the joint positions last shown [rad², rad², m²].
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
