#pragma once

#include <cmath>

namespace capstan::estimation {

/// Weights of the scaled unscented transform (van der Merwe 2004, section 3.2.2): lambda = alpha² (N + kappa)
/// − N, points at mean ± sqrt(N + lambda) S columns, W0m = lambda / (N + lambda), W0c = W0m + 1 − alpha² +
/// beta, Wi = 1 / (2 (N + lambda)).
///
/// These constants keep every weight positive. The predicted square root is then an orthogonal
/// triangularisation without a down-date, and rounding cannot make a covariance indefinite for any spread.
/// The customary alpha = 1e-3 has W0 near −10⁶ and loses six digits in the mean. beta = 2 is optimal for a
/// Gaussian prior.
struct SigmaRule {
  static constexpr double kAlpha = 1.0, kBeta = 2.0, kKappa = 1.0;

  static constexpr double lambda(int n) { return kAlpha * kAlpha * (n + kKappa) - n; }
  static double spread(int n) { return std::sqrt(n + lambda(n)); }
  static constexpr double centreMean(int n) { return lambda(n) / (n + lambda(n)); }
  static constexpr double centreCovariance(int n) { return centreMean(n) + 1.0 - kAlpha * kAlpha + kBeta; }
  static constexpr double other(int n) { return 0.5 / (n + lambda(n)); }
  /// Whether no weight is negative, as SquareRootUkf requires.
  static constexpr bool isPositive(int n) { return lambda(n) >= 0.0 && centreCovariance(n) >= 0.0; }
};

}  // namespace capstan::estimation
