#pragma once

#include <span>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// Quantisation step of samples in order of time: mean of the changes between neighbours that are below 1.5
/// times the smallest change. The samples count as quantised if at least 95 % of the changes up to ten steps
/// are whole multiples of the step, within 5 % of the step. Returns 0 for continuous samples and with fewer
/// than 20 changes. NaN samples are skipped.
double quantisationStep(std::span<const double> values);

/// Standard deviation of white noise under a smooth motion, estimated from differences. A difference of
/// order d has the noise variance C(2d, d) σ² (d = 2: 6 σ²), and the motion contributes less to it the higher
/// d is; but the estimate scatters more, by √(2 C(4d, 2d) / n) / C(2d, d) of itself for n differences. The
/// result is the estimate of the lowest order d = 2 … 6 that exceeds the least one by no more than two of its
/// standard deviations: the least one itself is too small by chance. Differences beyond 4.5 RMS are excluded,
/// and so are segments without any change, because a quantised channel hides its noise there. Samples are
/// equally spaced in time; NaN marks a missing sample, and no difference reaches over it. Returns 0 with
/// fewer than 20 second differences.
double whiteNoise(std::span<const double> values);

/// quantisationStep() and whiteNoise() of the same samples.
ChannelNoise channelNoise(std::span<const double> values);

}  // namespace capstan::diagnosis
