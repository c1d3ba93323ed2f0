#include "core/stats/t_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "core/stats/samples.h"
#include "core/stats/student_t.h"

namespace capstan::stats {
namespace {

/// Throws base::InputError when the spread is not above the rounding errors of samples of magnitude `size`.
void requireSpread(double standard_error, double size) {
  if (standard_error > 10.0 * std::numeric_limits<double>::epsilon() * size) return;
  throw base::InputError({{},
                          0,
                          "t-test",
                          fmt::format("standard error {}", standard_error),
                          "the samples do not vary, so t is undefined",
                          "Compare samples that come from separate measurements"});
}

TTest testOf(double difference, double standard_error, double nu, double confidence) {
  requireConfidence(confidence);
  const boost::math::students_t distribution(nu);
  const double half =
      standard_error * boost::math::quantile(boost::math::complement(distribution, (1.0 - confidence) / 2.0));
  const double t = difference / standard_error;
  const double log10_p = log10TwoSidedP(t, nu);
  return {t,
          nu,
          std::pow(10.0, log10_p),
          log10_p,
          difference,
          standard_error,
          {difference - half, difference + half}};
}

double sizeOf(const Moments& first, const Moments& second) {
  return std::max(std::abs(first.mean), std::abs(second.mean));
}

void requireTwo(const Moments& sample) {
  if (sample.n >= 2) return;
  throw base::InputError({{},
                          0,
                          "t-test",
                          fmt::format("{} samples", sample.n),
                          "at least 2 are needed",
                          "Give a larger sample"});
}

}  // namespace

TTest pairedTTest(std::span<const double> first, std::span<const double> second, double confidence) {
  if (first.size() != second.size())
    throw base::InputError({{},
                            0,
                            "paired t-test",
                            fmt::format("{} and {} samples", first.size(), second.size()),
                            "every sample needs its partner",
                            "Give two lists of one length, or use the two-sample test"});
  requireSamples(first, 2, "first sample");
  requireSamples(second, 2, "second sample");
  std::vector<double> differences(first.size());
  std::transform(first.begin(), first.end(), second.begin(), differences.begin(), std::minus<>());
  const Moments of = moments(differences);
  const double standard_error = of.standardDeviation() / std::sqrt(static_cast<double>(of.n));
  requireSpread(standard_error, std::max(rms(first), rms(second)));
  return testOf(of.mean, standard_error, static_cast<double>(of.n - 1), confidence);
}

TTest pooledTTest(const Moments& first, const Moments& second, double confidence) {
  requireTwo(first);
  requireTwo(second);
  const auto n1 = static_cast<double>(first.n);
  const auto n2 = static_cast<double>(second.n);
  const double nu = n1 + n2 - 2.0;
  const double pooled = ((n1 - 1.0) * first.variance + (n2 - 1.0) * second.variance) / nu;
  const double standard_error = std::sqrt(pooled * (1.0 / n1 + 1.0 / n2));
  requireSpread(standard_error, sizeOf(first, second));
  return testOf(first.mean - second.mean, standard_error, nu, confidence);
}

TTest welchTTest(const Moments& first, const Moments& second, double confidence) {
  requireTwo(first);
  requireTwo(second);
  const auto n1 = static_cast<double>(first.n);
  const auto n2 = static_cast<double>(second.n);
  const double v1 = first.variance / n1;
  const double v2 = second.variance / n2;
  const double standard_error = std::sqrt(v1 + v2);
  requireSpread(standard_error, sizeOf(first, second));
  const double share = v1 / (v1 + v2);  // ν as a function of shares: no squares of variances to underflow
  const double nu = 1.0 / (share * share / (n1 - 1.0) + (1.0 - share) * (1.0 - share) / (n2 - 1.0));
  return testOf(first.mean - second.mean, standard_error, nu, confidence);
}

TTest pooledTTest(std::span<const double> first, std::span<const double> second, double confidence) {
  requireSamples(first, 2, "first sample");
  requireSamples(second, 2, "second sample");
  return pooledTTest(moments(first), moments(second), confidence);
}

TTest welchTTest(std::span<const double> first, std::span<const double> second, double confidence) {
  requireSamples(first, 2, "first sample");
  requireSamples(second, 2, "second sample");
  return welchTTest(moments(first), moments(second), confidence);
}

}  // namespace capstan::stats
