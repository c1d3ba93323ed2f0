#pragma once

#include <span>

#include "core/stats/interval.h"
#include "core/stats/rms.h"

namespace capstan::stats {

/// Result of a two-sided t-test of equal means. A one-sided P in the direction of the sign of t is half of
/// p_value. Differences are first − second, in the unit of the samples.
struct TTest {
  double t = 0.0;  ///< mean_difference / standard_error
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< two-sided P; 0 when it is below the smallest double
  double log10_p = 0.0;  ///< log10 of the two-sided P; finite also when p_value is 0
  double mean_difference = 0.0;
  double standard_error = 0.0;  ///< standard error of mean_difference
  Interval interval;            ///< confidence interval of mean_difference
};

/// Paired t-test of n pairs: the one-sample test of their differences d, with standard error s_d / √n and n −
/// 1 degrees of freedom (Student 1908). Throws base::InputError when the lengths differ, there are fewer than
/// two pairs, a sample is not finite, or the differences do not vary.
TTest pairedTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);

/// Pooled t-test of two independent samples of equal variance: standard error s_p √(1/n₁ + 1/n₂) with
/// s_p² = ((n₁−1)s₁² + (n₂−1)s₂²)/ν and ν = n₁ + n₂ − 2. Throws base::InputError when a sample has fewer than
/// two values, a value is not finite, or neither sample varies.
TTest pooledTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);
TTest pooledTTest(const Moments& first, const Moments& second, double confidence = 0.95);

/// Welch's t-test (1947) of two independent samples of any variances: standard error √(v₁ + v₂), v = s²/n,
/// with Satterthwaite's ν = (v₁ + v₂)² / (v₁²/(n₁−1) + v₂²/(n₂−1)). Throws as pooledTTest().
TTest welchTTest(std::span<const double> first, std::span<const double> second, double confidence = 0.95);
TTest welchTTest(const Moments& first, const Moments& second, double confidence = 0.95);

}  // namespace capstan::stats
