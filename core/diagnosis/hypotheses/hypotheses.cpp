#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/diagnosis/hypotheses/library.h"

namespace capstan::diagnosis {
namespace library {

const robot::EffectFacts& factsOf(std::string_view name) {
  const robot::EffectFacts* facts = robot::effectNamed(name);
  CAPSTAN_CHECK(facts != nullptr);
  return *facts;
}

Starts usable(Starts all) {
  const auto finite = [](const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
  };
  std::erase_if(all, [&](const EffectStart& start) {
    return !finite(start.value) || !finite(start.scale) || !(start.scale.front() > 0.0);
  });
  return all;
}

double amplitude(const std::vector<double>& values, std::size_t count) {
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) squares += values.at(i) * values.at(i);
  return std::sqrt(squares);
}

}  // namespace library

namespace {

std::vector<Hypothesis> inOrderOfFacts() {
  using namespace library;
  std::vector<Hypothesis> all;
  for (const auto& part : {transmissionHypotheses(), cableHypotheses(), frictionHypotheses(),
                           rigidBodyHypotheses(), sensorHypotheses(), clockHypotheses()})
    all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all, {}, &Hypothesis::facts);
  return all;
}

}  // namespace

std::vector<EffectStart> Hypothesis::starts(const JointScales& scales, int joint) const {
  std::vector<EffectStart> all = grid(scales, joint);
  for (EffectStart& start : all) {
    CAPSTAN_CHECK(start.value.size() == facts->parameters.size() && start.scale.size() == start.value.size());
    for (std::size_t i = 0; i < start.value.size(); ++i)
      start.value[i] = std::clamp(start.value[i], facts->parameters[i].low, facts->parameters[i].high);
  }
  return all;
}

double stretchOfRange(const JointScales& s) {
  return (s.stretch + s.load / s.radius / s.stiffness) / (s.radius * s.range);
}

bool isPracticallyRigid(const JointScales& scales) {
  constexpr double kAsRigid = 0.01;  // stretch that has no visible effect
  return stretchOfRange(scales) < kAsRigid;
}

std::pair<double, double> eventTimes(const JointScales& scales) {
  const double margin = std::min(kFromEnds, 0.1 * scales.duration);
  return {margin, scales.duration - margin};
}

double firstMagnitude(const std::vector<double>& values) { return std::abs(values.at(0)); }

const std::vector<Hypothesis>& hypotheses() {
  static const std::vector<Hypothesis> all = inOrderOfFacts();
  return all;
}

const Hypothesis* hypothesisNamed(std::string_view name) {
  const auto& all = hypotheses();
  const auto found = std::ranges::find(all, name, &Hypothesis::name);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace capstan::diagnosis
