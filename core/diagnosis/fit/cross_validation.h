#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Squares of what a fit leaves, by channel and block of time.
struct BlockSquares {
  Eigen::MatrixXd sum;    ///< Σ e², channels × blocks [unit²]
  Eigen::MatrixXd count;  ///< numbers in it
  /// Numbers in which e forgets itself, by channel: ≥ 1. Of simulations what its correlation within blocks
  /// says, or how much more sums of blocks vary than those of independent numbers, whichever is more; of tip
  /// poses the latter.
  Eigen::VectorXd inflation;

  /// Of one channel, over all blocks [unit²]; 0: it has no numbers.
  double meanSquare(Eigen::Index channel) const;
};
BlockSquares squaresOf(const FitData& data, const Eigen::VectorXd& e);

/// Residuals in blocks that the fit has not seen. The blocks fall into kFolds folds, one block in kFolds to
/// each; without a fold the fit goes, by one Gauss–Newton step,
///     −(A − J_fᵀ J_f)⁻¹ J_fᵀ e_f,   A = Jᵀ J + priors
/// (what PRESS, Allen 1974, takes for exact), at most kLongestWay in any u and within the bounds; there the
/// robot is simulated again, initial states of rigid drives following, and the fold's residuals are those;
/// held-out segments fit nuisances of their own. Parameters at a bound stay there, and so do
/// instants of events, which one block alone knows. Costs one simulation of kFolds robots side by side.
Eigen::VectorXd heldOut(const FitData& data, const Fit& fit, const Weighting& weighting);
inline constexpr int kFolds = 16;
inline constexpr double kLongestWay = 1.0;

/// Covariance of u: the larger, number by number of its diagonal, of the model's (weights taken for true) and
/// the sandwich of the blocks' scores (Liang and Zeger 1986), which knows dependent and unequal errors. Rows
/// of parameters at a bound are zero.
Eigen::MatrixXd covarianceOf(const FitData& data, const Fit& fit, const Weighting& weighting);

/// Compares models by what they leave in blocks that they were not fitted to: Gaussian log likelihood with
/// each channel's scale free,  −½ Σ_c N_c ln (S_c / n_c),  N_c = n_c / inflation.
class Comparison {
 public:
  /// `draws` block bootstraps, the same for all models.
  Comparison(Eigen::Index blocks, int draws, std::uint64_t seed);
  Comparison(const FitData& data, int draws, std::uint64_t seed) : Comparison(data.blocks(), draws, seed) {}

  /// Score of `better` above `worse` [nats]: of all blocks, then of each draw.
  std::vector<double> gain(const BlockSquares& worse, const BlockSquares& better) const;

 private:
  Eigen::MatrixXd times_;  ///< blocks × (1 + draws): how often each is drawn; the first column is ones
};

/// 1 − S_c(better) / S_c(worse) of the channel where it is largest, and that channel; 0 where `worse` leaves
/// nothing in any.
struct Reduction {
  double share = 0.0;
  int channel = 0;
};
Reduction largestReduction(const BlockSquares& worse, const BlockSquares& better);

/// `p`-quantile of draws 1 … of gain().
double lowerOf(const std::vector<double>& gain, double p);

}  // namespace capstan::diagnosis
