#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace capstan::stats {

/// Counts in bins of equal width. Bin k is [edges[k], edges[k+1]); the last bin is closed, so that every
/// sample in [low, high] is in exactly one bin. A sample on an inner edge is in the bin above the edge.
struct Histogram {
  std::vector<double> edges;          ///< edges of the bins, ascending, one more than bins
  std::vector<std::uint64_t> counts;  ///< number of samples per bin
  std::uint64_t underflow = 0;        ///< number of samples below the first edge
  std::uint64_t overflow = 0;         ///< number of samples above the last edge

  /// Number of all samples, including those outside the bins.
  std::uint64_t total() const;
  double binWidth() const;
  /// Density per bin, counts / (total · width). It integrates to 1 when no sample is outside the bins. Zeros
  /// when there are no samples.
  std::vector<double> density() const;
};

/// Histogram with `bins` bins of equal width over [low, high]. Infinite samples count as outside; without
/// samples all bins are empty. Throws base::InputError when there are no bins, when the range is not finite,
/// not ascending or too narrow for bins that differ, and for a NaN sample (with its index).
Histogram histogram(std::span<const double> values, double low, double high, std::size_t bins);

/// Histogram over the range of the samples, with the largest bin width up to 2 · IQR · n^(−1/3) that divides
/// the range (Freedman and Diaconis 1981; quartiles as in quantile.h). When the quartiles are equal, Sturges'
/// rule ⌈log2 n⌉ + 1 gives the number of bins; when all samples are equal, there is one bin around them. At
/// least one and at most `most` bins. Throws base::InputError when there are no samples, one is not finite,
/// or the width of the range overflows a double.
Histogram histogramFreedmanDiaconis(std::span<const double> values, std::size_t most = 1000);

}  // namespace capstan::stats
