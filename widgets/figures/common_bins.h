#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace capstan::widgets {

/// Bins of equal width that several samples share.
struct CommonBins {
  double low = 0.0, high = 1.0;
  std::size_t count = 1;
};

/// Common bins over the range of all samples. The bin width is the smallest of the samples' Freedman–Diaconis
/// widths (1981), 2 IQR n^(−1/3). If that takes more than kMostBins bins, the range is cut to each sample's
/// quartiles widened by `kReach` IQR, so that a few far samples do not flatten the rest (stats::histogram
/// counts those outside); if it still takes more, the bins are widened. Empty without any sample. Values must
/// be finite.
std::optional<CommonBins> commonBins(const std::vector<std::span<const double>>& samples);

/// Largest number of bins.
inline constexpr std::size_t kMostBins = 100;
/// Number of interquartile ranges by which the quartiles are widened where the range is cut.
inline constexpr double kReach = 5.0;

}  // namespace capstan::widgets
