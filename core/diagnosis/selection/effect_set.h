#pragma once

#include <algorithm>
#include <compare>
#include <iterator>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

namespace capstan::diagnosis {

/// Effect on a joint, as a candidate for the model.
struct EffectCandidate {
  const Hypothesis* hypothesis = nullptr;
  int joint = 0;  ///< joint, from 1; 0: whole arm

  std::string_view name() const { return hypothesis->name(); }
  friend auto operator<=>(const EffectCandidate&, const EffectCandidate&) = default;
};

/// Effects of one candidate model, sorted, each at most once. Empty: the nominal model without effects.
/// `Effect` has an order and name().
template <class Effect>
using SetOf = std::vector<Effect>;
using EffectSet = SetOf<EffectCandidate>;

template <class Effect>
bool contains(const SetOf<Effect>& set, const std::type_identity_t<Effect>& effect) {
  return std::ranges::binary_search(set, effect);
}

template <class Effect>
SetOf<Effect> plus(SetOf<Effect> set, const std::type_identity_t<Effect>& effect) {
  const auto at = std::ranges::lower_bound(set, effect);
  if (at == set.end() || *at != effect) set.insert(at, effect);
  return set;
}

template <class Effect>
SetOf<Effect> minus(SetOf<Effect> set, const std::type_identity_t<Effect>& effect) {
  std::erase(set, effect);
  return set;
}

/// The set without the effect, and without effects that only make sense with it. A camera that rotates about
/// its own position is a rotation about frame 0 and an offset: without the rotation there is no offset
/// either.
template <class Effect>
SetOf<Effect> withoutEffect(SetOf<Effect> set, const std::type_identity_t<Effect>& effect) {
  set = minus(std::move(set), effect);
  if (effect.name() == "camera_rotation")
    std::erase_if(set, [](const Effect& one) { return one.name() == "camera_offset"; });
  return set;
}

}  // namespace capstan::diagnosis
