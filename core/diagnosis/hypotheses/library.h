#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

/// Library of the hypotheses: one file per Place, one entry per hypothesis. hypotheses() returns all of them.
namespace capstan::diagnosis::library {

std::vector<Hypothesis> transmissionHypotheses();
std::vector<Hypothesis> cableHypotheses();
std::vector<Hypothesis> frictionHypotheses();
std::vector<Hypothesis> rigidBodyHypotheses();
std::vector<Hypothesis> sensorHypotheses();
std::vector<Hypothesis> clockHypotheses();

using Starts = std::vector<EffectStart>;

/// Facts of the effect of this name, which must be in robot::effectFacts().
const robot::EffectFacts& factsOf(std::string_view name);

/// Starts of `all` that a fit can use: finite numbers, and a positive scale of the first number. None are
/// usable if the robot lacks what the effect needs (friction, stretch, a cable).
Starts usable(Starts all);

/// Euclidean norm of the first `count` values.
double amplitude(const std::vector<double>& values, std::size_t count);

}  // namespace capstan::diagnosis::library
