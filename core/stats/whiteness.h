#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::stats {

/// Sample autocorrelation r_k = Σ_{t=1}^{n−k} (x_t − x̄)(x_{t+k} − x̄) / Σ (x_t − x̄)², k = 0 … most_lag (Box
/// and Jenkins 1976, as R's acf); r_0 = 1. Samples equally spaced in time. Of white noise r_k, k > 0, is
/// about normal with deviation 1/√n. base::InputError: not more samples than lags, not finite, or samples
/// that are all the same.
std::vector<double> autocorrelation(std::span<const double> values, std::size_t most_lag);

struct LjungBox {
  double q = 0.0;
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< small: not white; 0 where it is smaller than a double can hold
};

/// Q = n(n + 2) Σ_{k=1}^{lags} r_k² / (n − k), χ² with lags − fitted degrees of freedom when the samples are
/// white (Ljung and Box 1978). `fitted`: parameters of a model whose residuals these are, fitted to the same
/// samples. base::InputError as autocorrelation, and without a degree of freedom left.
LjungBox ljungBox(std::span<const double> values, std::size_t lags, std::size_t fitted = 0);

}  // namespace capstan::stats
