#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit.h"

namespace capstan::diagnosis {

/// A model that was chosen, its numbers fitted anew to the open-loop simulation of whole recordings: for
/// rigid drives, whose effects are chosen by simulations that start anew after DiagnosisOptions::horizon.
/// Errors of force add up over a whole recording, so that its numbers simulate long motions better, and are
/// less sure where a recording has something that no effect explains. `robot` is the nominal one; starts at
/// `chosen`.
Fit wholeFit(const std::vector<Evidence>& recordings, const robot::Description& robot, const Fit& chosen,
             EncoderZeros zeros, int threads, const base::Progress* progress = nullptr);

}  // namespace capstan::diagnosis
