#include "core/stats/whiteness.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "core/base/error.h"
#include "core/stats/rms.h"
#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

/// Deviations x − x̄, scaled so that the largest has magnitude 1.
std::vector<double> scaledDeviations(std::span<const double> values) {
  const double centre = mean(values);
  std::vector<double> deviations(values.begin(), values.end());
  double largest = 0.0;
  for (double& d : deviations) {
    d -= centre;
    largest = std::max(largest, std::abs(d));
  }
  for (double& d : deviations) d /= largest;
  return deviations;
}

double laggedProduct(const std::vector<double>& d, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t t = 0; t + lag < d.size(); ++t) sum += d[t] * d[t + lag];
  return sum;
}

}  // namespace

std::vector<double> autocorrelation(std::span<const double> values, std::size_t most_lag) {
  requireSamples(values, std::max<std::size_t>(2, most_lag + 1), "autocorrelation");
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low == *high)
    throw base::InputError({{},
                            0,
                            "autocorrelation",
                            fmt::format("{}", *low),
                            "all samples are the same, so it is undefined",
                            "Take samples that vary"});
  const std::vector<double> deviations = scaledDeviations(values);
  const double power = laggedProduct(deviations, 0);
  std::vector<double> result(most_lag + 1);
  for (std::size_t k = 0; k <= most_lag; ++k) result[k] = laggedProduct(deviations, k) / power;
  return result;
}

LjungBox ljungBox(std::span<const double> values, std::size_t lags, std::size_t fitted) {
  if (lags <= fitted)
    throw base::InputError({{},
                            0,
                            "lags",
                            fmt::format("{}", lags),
                            fmt::format("must be more than the {} fitted parameters", fitted),
                            "Ask for more lags"});
  const std::vector<double> r = autocorrelation(values, lags);
  const auto n = static_cast<double>(values.size());
  double sum = 0.0;
  for (std::size_t k = 1; k <= lags; ++k) sum += r[k] * r[k] / (n - static_cast<double>(k));
  const double q = n * (n + 2.0) * sum;
  const auto freedom = static_cast<double>(lags - fitted);
  const boost::math::chi_squared distribution(freedom);
  return {q, freedom, boost::math::cdf(boost::math::complement(distribution, q))};
}

}  // namespace capstan::stats
