#pragma once

#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

/// Prior of sets of effects. An effect that happens once may have happened at any of the instants that score
/// tests try: its probability is shared by them, because the search takes the best one.
class SetPrior {
 public:
  SetPrior() = default;
  /// `candidates`: number of effects that the robot and its sensors can have.
  SetPrior(const std::vector<Evidence>& recordings, int candidates);

  /// Log prior [nats].
  double of(const EffectSet& effects) const;
  /// The same with the log prior of the fitted values (FitModel::logPrior()): masses, friction and effects
  /// that are far from usual need more evidence.
  double of(const SetFit& set) const;
  /// Fall of the log prior by one more effect that does not happen once [nats].
  double costOfOneMore(std::size_t effects) const;

 private:
  int candidates_ = 0;
  double instants_ = 1.0;
};

}  // namespace capstan::diagnosis
