#pragma once

#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::measured {

/// Selected model with its parameters refitted to the open-loop simulation of whole recordings, for rigid
/// drives. Their effects are selected with simulations that restart after each of kHorizons. Force errors
/// accumulate over a whole recording. The refitted parameters therefore simulate long motions better, but are
/// less accurate if a recording has an effect that the model lacks. `robot` is the nominal one; the fit
/// starts at `chosen`.
diagnosis::Fit wholeFit(const std::vector<diagnosis::Evidence>& recordings, const robot::Description& robot,
                        const diagnosis::Fit& chosen, diagnosis::EncoderZeros zeros, int threads);

}  // namespace capstan::measured
