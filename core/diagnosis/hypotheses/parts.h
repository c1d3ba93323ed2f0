#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "core/diagnosis/hypotheses/hypothesis.h"

/// What hypotheses have in common.
namespace capstan::diagnosis::library {

/// Those of `all` that a fit can begin at: finite numbers, and a first one that is free to move. Scales of a
/// robot that lacks something (no friction, no stretch, no cable) leave none. Values are brought within the
/// parameters' bounds.
std::vector<EffectStart> usable(const robot::EffectFacts& facts, std::vector<EffectStart> all);

/// Euclid's norm of the first `count` values.
double amplitude(const std::vector<double>& values, std::size_t count);

}  // namespace capstan::diagnosis::library
