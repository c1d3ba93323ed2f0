#pragma once

#include <compare>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

namespace capstan::diagnosis {

/// An effect at a joint, as a candidate for the model.
struct EffectCandidate {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;  ///< from 1; 0: whole arm

  friend auto operator<=>(const EffectCandidate&, const EffectCandidate&) = default;
};

/// Effects of one candidate model, sorted, each once. Empty: the nominal structure alone.
using EffectSet = std::vector<EffectCandidate>;

bool contains(const EffectSet& set, const EffectCandidate& effect);
EffectSet plus(EffectSet set, const EffectCandidate& effect);
EffectSet minus(EffectSet set, const EffectCandidate& effect);
/// True if `b` is `a` with exactly one effect exchanged for another one.
bool differByExchange(const EffectSet& a, const EffectSet& b);

}  // namespace capstan::diagnosis
