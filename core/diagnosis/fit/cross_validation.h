#pragma once

#include <Eigen/Core>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Sums of squared residuals of a fit, by channel and block of time.
struct BlockSquares {
  Eigen::MatrixXd sum;    ///< Σ e², channels × blocks [unit²]
  Eigen::MatrixXd count;  ///< number of residuals, channels × blocks
  /// Correlation length of e per channel, in residuals, ≥ 1. For simulations it is the larger of two
  /// estimates: from the autocorrelation within blocks, and from the variance of block sums over that of
  /// independent residuals. For tip poses it is the second.
  Eigen::VectorXd inflation;

  /// Mean square of one channel over all blocks [unit²]; 0 for a channel without residuals.
  double meanSquare(Eigen::Index channel) const;
};
/// Sums of squares of the residuals e, which are ordered as the data.
BlockSquares squaresOf(const FitData& data, const Eigen::VectorXd& e);

/// Covariance of u. Each variance is the larger of two: of the model's covariance, which assumes that the
/// weights are true, and of the sandwich estimator from the blocks' scores (Liang and Zeger 1986), which is
/// valid for correlated errors of unequal variance. Correlations are the model's. Rows and columns of
/// parameters at a bound are zero.
Eigen::MatrixXd covarianceOf(const FitData& data, const Fit& fit, const Weighting& weighting);

/// Reduction of one channel's sum of squares.
struct Reduction {
  double share = 0.0;  ///< 1 − S_c(better) / S_c(worse)
  int channel = 0;     ///< c
};
/// The largest reduction over the channels; share 0 if S_c(worse) is 0 in all of them.
Reduction largestReduction(const BlockSquares& worse, const BlockSquares& better);

}  // namespace capstan::diagnosis
