#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace capstan::widgets {

/// Equal bins over which several samples are compared.
struct CommonBins {
  double low = 0.0, high = 1.0;
  std::size_t count = 1;
};

/// Bins as narrow as the narrowest sample asks for by Freedman and Diaconis (1981), 2 IQR n^(−1/3), over the
/// range of all. A range that would take more than `most` bins is cut to each sample's quartiles widened by
/// `kReach` IQR, so that a few far samples do not flatten the rest (stats::histogram counts what lies
/// outside), and then the bins are widened. Nothing without a single sample. Values must be finite.
std::optional<CommonBins> commonBins(const std::vector<std::span<const double>>& samples,
                                     std::size_t most = 100);

/// Quartiles are widened by this many interquartile ranges where a range is cut.
inline constexpr double kReach = 5.0;

}  // namespace capstan::widgets
