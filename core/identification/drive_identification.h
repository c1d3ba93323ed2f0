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
  double step = 0.02;                   ///< time between rows [s]
  static constexpr double kSkip = 1.0;  ///< excluded start of each recording: unknown cable stretch [s]
  OffsetRule offsets = OffsetRule::kEach;
  double huber = 2.5;  ///< Huber's limit: residual above which it is down-weighted [standard deviations]
};

/// One identified parameter of a drive; the counterpart of Estimate.
struct DriveEstimate {
  DriveParameter parameter;
  double log = 0.0;    ///< ln(w / nominal)
  double sigma = 0.0;  ///< standard deviation of the logarithm
  bool seen = false;   ///< observable: the recordings at least halve the prior's sigma; else: nominal
  std::string advice;  ///< advice for the user; may be empty

  double value() const { return parameter.nominal * std::exp(log); }  ///< value, SI
  double valueSigma() const { return value() * sigma; }       ///< standard deviation to first order, SI
  double percent() const { return 100.0 * std::expm1(log); }  ///< change from nominal
  double low() const {
    return parameter.nominal * std::exp(log - stats::kNormal95 * sigma);
  }  ///< limits of the 95 % interval, SI
  double high() const { return parameter.nominal * std::exp(log + stats::kNormal95 * sigma); }
};

/// Zero of the joint encoder in one recording (or in all), relative to the robot file [rad or m].
struct DriveOffset {
  std::string title;
  double value = 0.0, sigma = 0.0;
};

struct DriveReport {
  BatchEnd end = BatchEnd::kFailed;
  std::vector<DriveEstimate> estimates;  ///< estimates of the requested parameters, by DriveQuantity
  Eigen::MatrixXd covariance;            ///< covariance of the logarithms of observable parameters
  Eigen::MatrixXd correlation;           ///< correlation of the same logarithms
  std::vector<DriveOffset> offsets;      ///< one for all recordings, or one per recording
  /// Slope [rad or m per N·m or N] and correlation of the recordings' offsets over their mean load. A
  /// correlation near ±1: the offsets are not encoder zeros but cable stretch in proportion to the mean load.
  /// Both are 0 with fewer than three offsets.
  double offset_by_load = 0.0, offset_load_correlation = 0.0;
  robot::Description robot;   ///< robot with the estimates, its hard stop moved by the mean offset
  double torque_sign = 1.0;   ///< sign of the recordings' tau_m; see torqueSign()
  double angle_noise = 0.0;   ///< robust standard deviation of the joint residuals [rad or m]
  double torque_noise = 0.0;  ///< robust standard deviation of the torque residuals [N·m]; 0 without torque
  double outliers = 0.0;      ///< share of residuals that the robust loss down-weights
  int observations = 0;       ///< number of residuals: angles and torques
  int iterations = 0;
  double seconds = 0.0;  ///< computing time [s]
};

/// Output-error identification of one cable drive with a measured load. Returns the maximum-a-posteriori
/// logarithms x and offsets o,
///     min  Σ_k ρ((q_k − q(x)_k − o_f) / s_q) + Σ_k ρ((±tau_m,k − tau_m(x)_k) / s_τ) + Σ_i (x_i / prior
///     σ_i)²,
/// where predict() simulates q(x) and tau_m(x) from motor position and load alone, and ρ is Huber's loss.
/// Ceres solves with automatic derivatives. s_q and s_τ are robust standard deviations of the residuals,
/// updated in turn with x. The joint encoder shows the cable stretch. The motor torque shows the stiffness,
/// which angles alone cannot distinguish from friction where the load hardly changes within a recording.
///
/// A parameter that is not observable in the recordings returns to its nominal value, and the others are
/// fitted again: so the stated errors are those of the robot in the report.
///
/// The covariance is the larger of inverse information and sandwich, as in identifyBatch(). The blocks of the
/// sandwich are whole recordings where there are more recordings than free parameters (an error of the model
/// repeats with every stroke), else kCorrelationBlock. Neither covers an error that all recordings share.
DriveReport identifyDrive(const std::vector<DriveRecording>& recordings, const DriveParameters& parameters,
                          const DriveOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::identification
