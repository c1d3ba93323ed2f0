#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace capstan::stats {

/// Counts in equal bins. Bin k is [edges[k], edges[k+1]), the last one closed, so every sample of [low, high]
/// is in exactly one; a sample on an inner edge is in the bin above it.
struct Histogram {
  std::vector<double> edges;          ///< ascending, one more than counts
  std::vector<std::uint64_t> counts;  ///< per bin
  std::uint64_t underflow = 0;        ///< below the first edge
  std::uint64_t overflow = 0;         ///< above the last

  /// All samples, those outside included.
  std::uint64_t total() const;
  double binWidth() const;
  /// Share of all samples per unit, counts / (total · width): with nothing outside it integrates to 1. Zeros
  /// when there are no samples.
  std::vector<double> density() const;
};

/// `bins` equal ones over [low, high]; infinities count as outside, no samples as empty bins.
/// base::InputError: no bins, a range that is not finite or not ascending, too narrow for its bins to differ,
/// or a NaN sample (with its index).
Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins);

/// Over the samples' own range, of width 2 · IQR · n^(−1/3) or the next smaller that divides it (Freedman and
/// Diaconis 1981; quartiles as in quantile.h). Where the quartiles coincide, Sturges' rule ⌈log2 n⌉ + 1 gives
/// the number of bins; where all samples do, there is one around them. At most `most` bins, at least one.
/// base::InputError: no samples, one that is not finite, or a range beyond what a double holds.
Histogram histogramFreedmanDiaconis(std::span<const double> values, std::size_t most = 1000);

}  // namespace capstan::stats
