#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/batch.h"
#include "core/identification/drive_parameters.h"
#include "core/identification/drive_recording.h"
#include "core/identification/drive_score.h"
#include "core/stats/interval.h"

namespace capstan::identification {

struct DriveOptions {
  double step = 0.02;                   ///< between rows [s]
  static constexpr double kSkip = 1.0;  ///< of every recording's beginning, whose stretch nobody knows [s]
  OffsetRule offsets = OffsetRule::kEach;
  bool torque = true;  ///< motor torque is an observation too, where it was measured
  double huber = 2.5;  ///< residual in standard deviations beyond which it counts less
  double block = 2.0;  ///< residuals this close in time may be correlated [s]
  int max_iterations = 60;
};

/// One identified parameter of a drive; as Estimate.
struct DriveEstimate {
  DriveParameter parameter;
  double log = 0.0;    ///< ln(w / nominal)
  double sigma = 0.0;  ///< standard deviation of the logarithm
  bool seen = false;   ///< the recordings at least halve the prior's sigma; else the value stays nominal
  std::string advice;  ///< plain words; empty where there is nothing to say

  double value() const { return parameter.nominal * std::exp(log); }  ///< SI
  double valueSigma() const { return value() * sigma; }               ///< SI, to first order
  double percent() const { return 100.0 * std::expm1(log); }          ///< change from nominal
  double low() const {
    return parameter.nominal * std::exp(log - stats::kNormal95 * sigma);
  }  ///< 95 % interval
  double high() const { return parameter.nominal * std::exp(log + stats::kNormal95 * sigma); }
};

/// Where the encoder of one recording (or of all) has its zero, beside the robot file's [rad or m].
struct DriveOffset {
  std::string title;
  double value = 0.0, sigma = 0.0;
};

struct DriveReport {
  BatchEnd end = BatchEnd::kFailed;
  std::vector<DriveEstimate> estimates;  ///< those requested, in the order of DriveQuantity
  Eigen::MatrixXd covariance;            ///< of the logarithms of those seen
  Eigen::MatrixXd correlation;           ///< the same
  std::vector<DriveOffset> offsets;      ///< one, or one a recording
  /// Regression of the recordings' offsets on their mean load: near ±1, the fitted
  /// offsets are not encoder zeros but cable stretch in proportion to the mean load. 0 with fewer than three
  /// offsets.
  double offset_by_load = 0.0, offset_load_correlation = 0.0;
  robot::Description robot;   ///< with the estimates, its hard stop moved by the mean offset
  double torque_sign = 1.0;   ///< of the recordings' tau_m, see torqueSign()
  double angle_noise = 0.0;   ///< standard deviation of the residuals, robust [rad or m]
  double torque_noise = 0.0;  ///< the same [N·m]; 0 without torque
  double outliers = 0.0;      ///< share of residuals that the robust loss holds back
  int observations = 0;       ///< residuals: angles and torques
  int iterations = 0;
  double seconds = 0.0;  ///< of computing
};

/// Output-error identification of one cable drive whose load is measured: the logarithms x and offsets o of
/// most posterior probability,
///     min  Σ_k ρ((q_k − q(x)_k − o_f) / s_q) + Σ_k ρ((±tau_m,k − tau_m(x)_k) / s_τ) + Σ_i (x_i / prior
///     σ_i)²,
/// q(x), tau_m(x) as predict() simulates them from motor position and load alone, ρ Huber's loss; Ceres with
/// automatic derivatives. s_q and s_τ are taken from the residuals themselves (their median), in turn with x.
/// The joint encoder shows what stretches; the motor torque shows how stiff it is, which angles alone cannot
/// distinguish from friction where the load hardly changes within a recording.
///
/// A parameter that the recordings do not show goes back to its nominal value, and the others are fitted
/// again with it: the robot of the report is the model whose errors are stated.
///
/// The covariance is as identifyBatch()'s, the larger of inverse information and sandwich. The sandwich's
/// blocks are whole recordings where there are more of them than unknown parameters (an error of the model
/// repeats with every stroke), else `block` seconds. Neither knows of an error that all recordings share.
DriveReport identifyDrive(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
                          const DriveOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::identification
