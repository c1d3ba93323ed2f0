#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::stats {

/// Sample autocorrelation r_k = Σ_{t=1}^{n−k} (x_t − x̄)(x_{t+k} − x̄) / Σ (x_t − x̄)², k = 0 … most_lag (Box
/// and Jenkins 1976, as R's acf); r_0 = 1. The samples are equally spaced in time. For white noise, r_k with
/// k > 0 is approximately normal with standard deviation 1/√n. Throws base::InputError when there are not
/// more samples than lags, a sample is not finite, or all samples are equal.
std::vector<double> autocorrelation(std::span<const double> values, std::size_t most_lag);

struct LjungBox {
  double q = 0.0;
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< P of white samples; 0 when it is below the smallest double
};

/// Ljung–Box test of whiteness (1978): Q = n(n + 2) Σ_{k=1}^{lags} r_k² / (n − k), which has a χ²
/// distribution with lags − fitted degrees of freedom when the samples are white. `fitted` is the number of
/// parameters that were fitted to the same samples, when these are the residuals of a model. Throws as
/// autocorrelation(), and when no degree of freedom remains.
LjungBox ljungBox(std::span<const double> values, std::size_t lags, std::size_t fitted = 0);

}  // namespace capstan::stats
