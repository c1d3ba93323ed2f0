#pragma once

#include <cmath>

namespace capstan::estimation {

/// Weights of the scaled unscented transform (van der Merwe 2004, section 3.2.2): lambda = alpha² (N + kappa)
/// − N, points at mean ± sqrt(N + lambda) S columns, W0m = lambda / (N + lambda), W0c = W0m + 1 − alpha² +
/// beta, Wi = 1 / (2 (N + lambda)).
///
/// The defaults keep every weight positive. Then the predicted square root is a plain orthogonal
/// triangularisation with nothing to down-date, and no rounding, however large the spread, can make a
/// covariance indefinite; the customary alpha = 1e-3 has W0 near −10⁶ and loses six digits in the mean. beta
/// = 2 is right for a Gaussian prior.
struct SigmaRule {
  double alpha = 1.0;
  double beta = 2.0;
  double kappa = 1.0;

  constexpr double lambda(int n) const { return alpha * alpha * (n + kappa) - n; }
  double spread(int n) const { return std::sqrt(n + lambda(n)); }
  constexpr double centreMean(int n) const { return lambda(n) / (n + lambda(n)); }
  constexpr double centreCovariance(int n) const { return centreMean(n) + 1.0 - alpha * alpha + beta; }
  constexpr double other(int n) const { return 0.5 / (n + lambda(n)); }
  /// No negative weight: what SquareRootUkf demands.
  constexpr bool isPositive(int n) const { return lambda(n) >= 0.0 && centreCovariance(n) >= 0.0; }
};

}  // namespace capstan::estimation
