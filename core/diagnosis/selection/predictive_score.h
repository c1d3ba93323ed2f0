#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/diagnosis/fit/cross_validation.h"

namespace capstan::diagnosis {

/// Log predictive density of candidate models on held-out blocks [nats]:
///     −½ Σ_g N_g ln max(S_g / n_g, floor_g),   N_g = n_g / inflation_g.
/// A group g has the channels of all recordings that read the same thing (a joint's encoder, an axis of the tip), and one
/// discrepancy variance S_g / n_g: recordings of one robot share it, so that one recording that is fitted perfectly cannot
/// outvote others that are not. floor_g is the variance that sensors leave at least. inflation_g is the
/// number of samples in which the residual forgets itself, the least of all models that were learned: all are counted alike.
class PredictiveScore {
 public:
  /// `input_noise`: RMS per channel that noise of the inputs brings in (inputNoise()). `draws`: block bootstraps.
  PredictiveScore(const FitData& data, const Eigen::VectorXd& input_noise, int draws, std::uint64_t seed);

  /// Takes over the inflation of a model's residuals where it is less than that of all before.
  void learnInflation(const BlockSquares& squares);
  /// Score of all blocks; −infinity for residuals that are not finite.
  double of(const BlockSquares& squares) const;
  /// Scores of all block bootstraps, in the same order for every model.
  Eigen::VectorXd ofDraws(const BlockSquares& squares) const;

 private:
  Eigen::MatrixXd pooled(const Eigen::MatrixXd& by_channel) const;
  Eigen::VectorXd scores(const Eigen::MatrixXd& sum, const Eigen::MatrixXd& count) const;

  std::vector<Eigen::Index> group_;  ///< of each channel
  Eigen::VectorXd floor_, inflation_;  ///< of each group
  Eigen::MatrixXd times_;  ///< blocks × draws: how often each is drawn
};

}  // namespace capstan::diagnosis
