#pragma once

#include <optional>
#include <vector>

#include "core/robot/chain/chain_law.h"
#include "core/robot/chain/chain_model.h"
#include "core/tracking/sample.h"

namespace capstan::tracking {

/// Converts motor encoder readings to those of a robot with round capstans, encoders that never slipped and
/// constant zeros: the cable travel at the motor minus the travel of the joints' zeros (motorTravel, slipAt
/// and zeroShiftAt in robot/chain/chain_law.h), divided by r_mc / N.
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

  /// `robot` without the effects that this class corrects.
  static robot::Description undone(robot::Description robot) {
    std::erase_if(robot.effects,
                  [](const robot::Effect& effect) { return (robot::lawOf(effect.effect) & kLaws) != 0; });
    return robot;
  }

  /// Laws that this class corrects.
  static constexpr unsigned kOwnLaws = robot::kLawEccentricity | robot::kLawSlip;  ///< laws of a single motor
  static constexpr unsigned kLaws = kOwnLaws | robot::kLawZeroDrift;

 private:
  /// Adds the motor movement that is equivalent to the drift of the cable's zero.
  void holdZero(int j, MotorSample& sample) const {
    const robot::ZeroShift<double> zero = robot::zeroShiftAt(model_->numbers.joints[j], sample.t);
    const robot::JointNumbers<double>& p = model_->numbers.joints[j];
    const double ratio = p.link_radius * model_->numbers.coupling[j][j] / p.lever;
    sample.position[j] += ratio * zero.by;
    sample.velocity[j] += ratio * zero.rate;
  }

  static constexpr double kStep = 1e-3;  // [s]
  std::optional<robot::ChainModel> model_;
};

}  // namespace capstan::tracking
