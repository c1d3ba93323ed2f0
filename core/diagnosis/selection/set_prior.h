#pragma once

#include <map>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

/// Prior of sets of effects. An effect whose law has several forms (Hypothesis::forms(): periods, speeds,
/// time constants), and one that happens once at any of many instants, is as probable as any other: its
/// probability is shared by its forms or instants, because the search takes the best of them.
class SetPrior {
 public:
  SetPrior() = default;
  /// `candidates`: number of effects that the robot and its sensors can have.
  SetPrior(const std::vector<Evidence>& recordings, const std::vector<JointScales>& scales, int candidates);

  /// Log prior [nats].
  double of(const EffectSet& effects) const;
  /// The same with the log prior of the fitted values (FitModel::logPrior()): masses, friction and effects
  /// that are far from usual need more evidence.
  double of(const SetFit& set) const;
  /// Fall of the log prior by one more effect of a single form [nats].
  double costOfOneMore(std::size_t effects) const;

 private:
  int candidates_ = 0;
  std::map<EffectCandidate, double> log_forms_;  ///< logarithm of the number of forms or instants
};

}  // namespace capstan::diagnosis
