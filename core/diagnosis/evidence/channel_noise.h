#pragma once

#include <span>

#include "core/diagnosis/evidence/evidence.h"

namespace capstan::diagnosis {

/// Quantisation step of samples in order of time: the smallest change from one to the next, averaged over
/// those within half of it, where at least 95 % of the changes up to ten of it are whole multiples within
/// 5 % of it. 0 where they are not: the samples are continuous, or never change. NaN samples are passed over.
double quantisationStep(std::span<const double> values);

/// Standard deviation of white noise under a smooth motion, by differences: those of order d keep
/// C(2d, d) σ² of the noise and ever less of the motion (d = 2: the second difference, 6 σ²). The least over
/// d = 2 … 6 counts; squares beyond 4.5 RMS are excluded, and so are segments without any change, where a
/// quantised channel hides its noise. Samples equally spaced in time but for NaN, which no difference
/// reaches over. 0 with fewer than 20 differences of an order: nothing can be said.
double whiteNoise(std::span<const double> values);

ChannelNoise channelNoise(std::span<const double> values);

}  // namespace capstan::diagnosis
