#include "core/diagnosis/hypotheses/parts.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace capstan::diagnosis::library {

std::vector<EffectStart> usable(const robot::EffectFacts& facts, std::vector<EffectStart> all) {
  const auto finite = [](const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  };
  std::erase_if(all, [&](const EffectStart& start) {
    assert(start.value.size() == facts.parameters.size() && start.scale.size() == start.value.size());
    return !finite(start.value) || !finite(start.scale) || !(start.scale.front() > 0.0);
  });
  for (EffectStart& start : all)
    for (std::size_t i = 0; i < start.value.size(); ++i)
      start.value[i] = std::clamp(start.value[i], facts.parameters[i].low, facts.parameters[i].high);
  return all;
}

double amplitude(const std::vector<double>& values, std::size_t count) {
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) squares += values.at(i) * values.at(i);
  return std::sqrt(squares);
}

}  // namespace capstan::diagnosis::library
