#pragma once

#include <optional>
#include <vector>

#include "core/robot/chain/chain_law.h"
#include "core/robot/chain/chain_model.h"
#include "core/tracking/sample.h"

namespace capstan::tracking {

/// Readings of motor encoders, converted to those of a robot with round capstans, encoders that never slipped
/// and constant zeros: the same cable travel at the motor, less that of the joints' zeros (motorTravel,
/// slipAt and zeroShiftAt in robot/chain/chain_law.h), over r_mc / N.
class MotorReading {
 public:
  explicit MotorReading(const robot::Description& robot) {
    const robot::ChainModel model(robot);
    for (int i = 0; i < 3; ++i)
      if (model.shape.laws[i] & kLaws) model_ = model;
  }

  MotorSample asRound(MotorSample sample) const {
    if (!model_) return sample;
    for (int i = 0; i < 3; ++i) {
      const robot::JointNumbers<double>& p = model_->numbers.joints[i];
      const unsigned laws = model_->shape.laws[i];
      if (!(laws & kOwnLaws)) continue;
      double slip = 0.0, rate = 0.0;
      if (laws & robot::kLawSlip) {
        slip = robot::slipAt(p, sample.t);
        rate = (slip - robot::slipAt(p, sample.t - kStep)) / kStep;
      }
      const double angle = sample.position[i] + slip;
      sample.position[i] = robot::motorTravel(p, laws, angle) / p.lever;
      sample.velocity[i] = robot::motorLever(p, laws, angle) * (sample.velocity[i] + rate) / p.lever;
    }
    for (int j = 0; j < 3; ++j)
      if (model_->shape.laws[j] & robot::kLawZeroDrift) holdZero(j, sample);
    return sample;
  }

  /// The robot without what is dealt with here.
  static robot::Description undone(robot::Description robot) {
    std::erase_if(robot.effects,
                  [](const robot::Effect& effect) { return (robot::lawOf(effect.effect) & kLaws) != 0; });
    return robot;
  }

  /// Laws that are dealt with here.
  static constexpr unsigned kOwnLaws = robot::kLawEccentricity | robot::kLawSlip;  ///< by one motor each
  static constexpr unsigned kLaws = kOwnLaws | robot::kLawZeroDrift;

 private:
  /// To the cables a zero that moves is as if the motors went on by as much.
  void holdZero(int j, MotorSample& sample) const {
    const robot::ZeroShift<double> zero = robot::zeroShiftAt(model_->numbers.joints[j], sample.t);
    for (int i = 0; i < 3; ++i) {
      const robot::JointNumbers<double>& p = model_->numbers.joints[i];
      const double ratio = p.link_radius * model_->numbers.coupling[i][j] / p.lever;
      sample.position[i] += ratio * zero.by;
      sample.velocity[i] += ratio * zero.rate;
    }
  }

  static constexpr double kStep = 1e-3;  // [s]
  std::optional<robot::ChainModel> model_;
};

}  // namespace capstan::tracking
