#pragma once

#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::measured {

/// A model that was chosen, its numbers refitted to the open-loop simulation of whole recordings: for
/// rigid drives, whose effects are chosen by simulations that restart after kFarHorizon at the latest.
/// Errors of force add up over a whole recording, so that its numbers simulate long motions better, and are
/// less sure where a recording has something that no effect explains. `robot` is the nominal one; starts at
/// `chosen`.
diagnosis::Fit wholeFit(const std::vector<diagnosis::Evidence>& recordings, const robot::Description& robot,
                        const diagnosis::Fit& chosen, diagnosis::EncoderZeros zeros, int threads);

}  // namespace capstan::measured
