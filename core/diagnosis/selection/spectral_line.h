#pragma once

#include <optional>
#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// Most significant line in the spectrum of a channel's residual, between kLowestLine and the smaller of
/// kHighestLine and 0.45 of the sampling rate. It detects vibrations, which smooth processes cannot
/// represent. The statistic is the ratio of the periodogram to its moving median. p follows from
/// exponentially distributed ratios at all frequencies (Fisher 1929 for unequal noise). Returns nothing if p
/// ≥ kLineChance or with too few samples.
std::optional<SpectralLine> spectralLine(const Channel& channel);
inline constexpr double kLowestLine = 1.5, kHighestLine = 40.0;  ///< range of frequencies [Hz]
inline constexpr double kLineChance = 1e-6;                      ///< largest p of a reported line

}  // namespace capstan::diagnosis
