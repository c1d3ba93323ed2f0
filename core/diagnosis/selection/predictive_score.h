#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/fit/input_noise.h"

namespace capstan::diagnosis {

/// Sensor and noise of each channel of the residuals that are scored.
struct ScoredChannels {
  std::vector<Eigen::Index> sensor;
  Eigen::VectorXd noise;     ///< RMS per channel of the sensor's noise
  InputNoise input, torque;  ///< inputNoise() and torqueNoise()
};
/// Noise in simulations of a fitted robot.
ScoredChannels scoredChannels(const FitData& data, const Fit& at, const Weighting& weighting);

/// Log predictive density of candidate models on held-out blocks [nats]:
///     −½ Σ_g N_g ln max(S_g / n_g, floor_g),   N_g = n_g / inflation_g.
/// A group g contains the channels of all recordings with the same sensor (a joint's encoder, an axis of the
/// tip) and has one residual variance S_g / n_g. Recordings of one robot share it, so that one recording that
/// is fitted perfectly cannot outvote the others. floor_g is kSensorConfidence times the variance of the
/// sensor's noise, which is an estimate, plus the variance that noise of the inputs causes.
/// inflation_g is the correlation length of the residual in samples: that of the model which fits the sensor
/// best, at least that of the noise in such a residual, and the same for all models. Noise has three parts:
/// of the sensor, which is white; of the inputs; and of torques between the rows as far as the residual
/// exceeds the other two, because this part is known by its upper bound only.
class PredictiveScore {
 public:
  /// `blocks`: number of blocks of the residuals. `draws`: number of block bootstraps.
  PredictiveScore(const ScoredChannels& channels, Eigen::Index blocks, int draws, std::uint64_t seed);

  /// Takes the inflation of this model's residuals for the groups that no model has fitted better: a model
  /// that fits badly may have residuals that look random. Of models within the noise the least inflation
  /// counts.
  void learnInflation(const BlockSquares& squares);
  /// Score of all blocks; −infinity for residuals that are not finite.
  double of(const BlockSquares& squares) const;
  /// Largest score that a model can gain that a score test predicts to remove `share` of the mean square:
  /// −½ k Σ_g N_g ln(1 − share), and not more than room(). A refit may gain k = kBeyondTest times as much as
  /// the first order of the test.
  double mostGain(const BlockSquares& squares, double share) const;
  /// Largest score that any model can gain whose variances become the sensors' and the inputs'.
  double room(const BlockSquares& squares) const;
  /// Largest RMS of a residual over that of the noise.
  double excess(const BlockSquares& squares) const;
  /// Scores of all block bootstraps, in the same order for every model.
  Eigen::VectorXd ofDraws(const BlockSquares& squares) const;

 private:
  Eigen::MatrixXd pooled(const Eigen::MatrixXd& by_channel) const;
  Eigen::VectorXd variances(const BlockSquares& squares) const;
  Eigen::VectorXd scores(const Eigen::MatrixXd& sum, const Eigen::MatrixXd& count,
                         const Eigen::VectorXd& floor) const;

  /// Noise of a group's residual.
  struct GroupNoise {
    double sensor = 0.0, input = 0.0, torque = 0.0;            ///< variances
    double input_correlation = 1.0, torque_correlation = 1.0;  ///< InputNoise::correlation
    /// Correlation length of the noise in a residual with this variance.
    double inflation(double variance) const;
  };

  std::vector<Eigen::Index> group_;            ///< group of each channel
  Eigen::VectorXd noise_, floor_, inflation_;  ///< variances and correlation length, one entry per group
  std::vector<GroupNoise> parts_;              ///< noise of each group
  Eigen::VectorXd best_;   ///< smallest variance of a residual so far, not below the noise
  Eigen::MatrixXd times_;  ///< how often each block is drawn, blocks × draws
};
inline constexpr double kBeyondTest = 2.0;
inline constexpr double kSensorConfidence = 0.9;

}  // namespace capstan::diagnosis
