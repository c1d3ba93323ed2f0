#pragma once

#include <compare>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

namespace capstan::diagnosis {

/// Effect on a joint, as a candidate for the model.
struct EffectCandidate {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;  ///< joint, from 1; 0: whole arm

  friend auto operator<=>(const EffectCandidate&, const EffectCandidate&) = default;
};

/// Effects of one candidate model, sorted, each at most once. Empty: the nominal robot without effects.
using EffectSet = std::vector<EffectCandidate>;

bool contains(const EffectSet& set, const EffectCandidate& effect);
EffectSet plus(EffectSet set, const EffectCandidate& effect);
EffectSet minus(EffectSet set, const EffectCandidate& effect);
/// True if the two sets differ by the exchange of exactly one effect for another.
bool differByExchange(const EffectSet& a, const EffectSet& b);

}  // namespace capstan::diagnosis
