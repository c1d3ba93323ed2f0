#pragma once

#include <optional>
#include <string>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/residuals/residual.h"

namespace capstan::diagnosis {

/// The line that stands out most in the spectrum of a channel's residual between kLowestLine and the half of
/// its sampling rate (kHighestLine at most): periodogram over what a moving median of it is, p from
/// exponentially distributed ratios, all frequencies counted (Fisher 1929 for unequal noise). Smooth
/// processes do not see a vibration; this does. None where it could be chance (p > kLineChance) or there are
/// too few samples.
std::optional<SpectralLine> spectralLine(const Channel& channel);
inline constexpr double kLowestLine = 1.5, kHighestLine = 40.0;  ///< [Hz]
inline constexpr double kLineChance = 1e-6;

}  // namespace capstan::diagnosis
