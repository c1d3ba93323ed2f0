#pragma once

#include <span>

#include "core/stats/interval.h"
#include "core/stats/rms.h"

namespace capstan::stats {

/// Student's t-test of equal means, against means that differ in either direction; a one-sided P is half of
/// p_value on the side of t's sign. Differences are first − second, in the unit of the samples.
struct TTest {
  double t = 0.0;  ///< mean_difference / standard_error
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< two-sided; 0 where it is smaller than a double can hold
  double log10_p = 0.0;  ///< of the two-sided P; finite then, too
  double mean_difference = 0.0;
  double standard_error = 0.0;  ///< of mean_difference
  Interval interval;            ///< of mean_difference, at the requested confidence
};

/// Of n pairs: the one-sample test of their differences d, standard error s_d / √n, n − 1 degrees of freedom
/// (Student 1908). base::InputError: samples of different length, fewer than two, not finite, no spread in d.
TTest pairedTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);

/// Of two independent samples of one variance: standard error s_p √(1/n₁ + 1/n₂), s_p² = ((n₁−1)s₁² +
/// (n₂−1)s₂²)/ν, ν = n₁ + n₂ − 2. base::InputError: fewer than two in a sample, not finite, no spread in
/// either.
TTest pooledTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);
TTest pooledTTest(const Moments& first, const Moments& second, double confidence = 0.95);

/// Of two independent samples of any variances (Welch 1947): standard error √(v₁ + v₂), v = s²/n, with
/// Satterthwaite's ν = (v₁ + v₂)² / (v₁²/(n₁−1) + v₂²/(n₂−1)). base::InputError as pooledTTest.
TTest welchTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);
TTest welchTTest(const Moments& first, const Moments& second, double confidence = 0.95);

}  // namespace capstan::stats
