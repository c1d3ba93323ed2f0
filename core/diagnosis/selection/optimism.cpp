#include "core/diagnosis/selection/optimism.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace capstan::diagnosis {

std::map<EffectSet, double> heldOutScores(const std::map<EffectSet, SetFit>& sets,
                                          const PredictiveScore& score) {
  struct Settled {
    const EffectSet* effects;
    double fitted, optimism;
  };
  std::vector<Settled> settled;
  for (const auto& [effects, set] : sets) {
    if (!set.settled) continue;
    const double fitted = score.of(set.fitted), held_out = score.of(set.squares);
    const double none = std::numeric_limits<double>::infinity();
    settled.push_back({&effects, fitted, held_out > -none ? fitted - held_out : none});
  }
  std::map<EffectSet, double> scores;
  for (const Settled& one : settled) {
    double optimism = one.optimism;
    for (const Settled& other : settled)
      if (std::ranges::includes(*other.effects, *one.effects)) optimism = std::min(optimism, other.optimism);
    scores[*one.effects] = one.fitted - optimism;
  }
  return scores;
}

}  // namespace capstan::diagnosis
