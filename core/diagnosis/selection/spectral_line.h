#pragma once

#include <optional>
#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// Most significant line in the spectrum of a channel's residual, between kLowestLine and the smaller of
/// kHighestLine and 0.45 of the rate of the (thinned) samples. It detects vibrations, which smooth processes
/// cannot represent. The statistic is the ratio of the periodogram to its local mean, moving median / ln 2. p
/// is the probability that chance makes the largest of these ratios this large, if they are independent and
/// exponential (Fisher 1929, with a noise level per frequency). Nothing if p ≥ kLineChance, or too few
/// samples.
std::optional<SpectralLine> spectralLine(const Channel& channel);
inline constexpr double kLowestLine = 1.5, kHighestLine = 40.0;  ///< range of frequencies [Hz]
inline constexpr double kLineChance = 1e-6;                      ///< largest p of a reported line

}  // namespace capstan::diagnosis
