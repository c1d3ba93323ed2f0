#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

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

/// Compares models by their held-out residuals, with the Gaussian log likelihood maximized over each
/// channel's variance: −½ Σ_c N_c ln (S_c / n_c),  N_c = n_c / inflation.
class Comparison {
 public:
  /// Draws `draws` block-bootstrap samples, which are the same for all models.
  Comparison(Eigen::Index blocks, int draws, std::uint64_t seed);
  Comparison(const FitData& data, int draws, std::uint64_t seed) : Comparison(data.blocks(), draws, seed) {}

  /// Log likelihood of `better` minus that of `worse` [nats]: first for all blocks, then for each draw.
  std::vector<double> gain(const BlockSquares& worse, const BlockSquares& better) const;

 private:
  Eigen::MatrixXd times_;  ///< how often each block is drawn, blocks × (1 + draws); first column: ones
};

/// Reduction of one channel's sum of squares.
struct Reduction {
  double share = 0.0;  ///< 1 − S_c(better) / S_c(worse)
  int channel = 0;     ///< c
};
/// The largest reduction over the channels; share 0 if S_c(worse) is 0 in all of them.
Reduction largestReduction(const BlockSquares& worse, const BlockSquares& better);

/// `p`-quantile of gain() over the bootstrap draws; without draws, the gain over all blocks.
double lowerOf(const std::vector<double>& gain, double p);

}  // namespace capstan::diagnosis
