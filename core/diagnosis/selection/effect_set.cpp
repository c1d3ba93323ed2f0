#include "core/diagnosis/selection/effect_set.h"

#include <algorithm>
#include <iterator>

namespace capstan::diagnosis {

bool contains(const EffectSet& set, const EffectCandidate& effect) {
  return std::ranges::binary_search(set, effect);
}

EffectSet plus(EffectSet set, const EffectCandidate& effect) {
  const auto at = std::ranges::lower_bound(set, effect);
  if (at == set.end() || *at != effect) set.insert(at, effect);
  return set;
}

EffectSet minus(EffectSet set, const EffectCandidate& effect) {
  std::erase(set, effect);
  return set;
}

bool differByExchange(const EffectSet& a, const EffectSet& b) {
  EffectSet shared;
  std::ranges::set_intersection(a, b, std::back_inserter(shared));
  return a.size() == b.size() && shared.size() + 1 == a.size();
}

}  // namespace capstan::diagnosis
