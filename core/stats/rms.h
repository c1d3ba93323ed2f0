#pragma once

#include <cstddef>
#include <span>

namespace capstan::stats {

/// Count, mean and unbiased variance of a sample, as a t-test needs them.
struct Moments {
  std::size_t n = 0;
  double mean = 0.0;
  double variance = 0.0;  ///< Σ(x − x̄)² / (n − 1)

  double standardDeviation() const;
};

// The functions below take values in any unit and return the same unit (the variance its square). Sums are
// compensated (Neumaier 1974). The variance is the corrected two-pass form Σd² − (Σd)²/n over n − 1, d = x −
// x̄ (Chan, Golub and LeVeque 1983), so that a large common offset causes no further rounding than the samples
// themselves have lost. Samples are scaled by a power of two, so that squares neither overflow nor underflow;
// only the variance itself can. Throws base::InputError when there are no samples (fewer than two for a
// variance or standard deviation) or one is not finite.
double rms(std::span<const double> values);  ///< sqrt(Σx² / n)
double mean(std::span<const double> values);
double variance(std::span<const double> values);
double standardDeviation(std::span<const double> values);
Moments moments(std::span<const double> values);

}  // namespace capstan::stats
