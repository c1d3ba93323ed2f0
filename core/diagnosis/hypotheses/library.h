#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

/// The hypotheses, a file for each Place and an entry for each hypothesis; hypotheses() lists them.
namespace capstan::diagnosis::library {

std::vector<Hypothesis> transmissionHypotheses();
std::vector<Hypothesis> cableHypotheses();
std::vector<Hypothesis> frictionHypotheses();
std::vector<Hypothesis> rigidBodyHypotheses();
std::vector<Hypothesis> sensorHypotheses();
std::vector<Hypothesis> clockHypotheses();

using Starts = std::vector<EffectStart>;

/// Of the effect of this name, which has to be in robot::effectFacts().
const robot::EffectFacts& factsOf(std::string_view name);

/// Those of `all` that a fit can begin at: finite numbers, and a first one that is free to move. Scales of a
/// robot that lacks something (no friction, no stretch, no cable) leave none.
Starts usable(Starts all);

/// Euclid's norm of the first `count` values.
double amplitude(const std::vector<double>& values, std::size_t count);

}  // namespace capstan::diagnosis::library
