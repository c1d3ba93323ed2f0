#pragma once

#include <cstddef>
#include <span>

namespace capstan::stats {

/// Count, mean and unbiased variance of a sample: all that a t-test of it needs.
struct Moments {
  std::size_t n = 0;
  double mean = 0.0;
  double variance = 0.0;  ///< Σ(x − x̄)² / (n − 1)

  double standardDeviation() const;
};

/// Values in any unit, results in the same (variance in its square). Sums are compensated (Neumaier 1974) and
/// the variance is the corrected two-pass form Σd² − (Σd)²/n over n − 1, d = x − x̄ (Chan, Golub and LeVeque
/// 1983), so a large offset costs no digits beyond those that the samples themselves have lost. Samples of
/// any magnitude that a double holds are scaled by a power of two, so squares neither overflow nor vanish
/// (but for the variance itself). base::InputError: no samples (fewer than two where a spread is requested),
/// or one that is not finite.
double rms(std::span<const double> values);  ///< sqrt(Σx² / n)
double mean(std::span<const double> values);
double variance(std::span<const double> values);
double standardDeviation(std::span<const double> values);
Moments moments(std::span<const double> values);

}  // namespace capstan::stats
