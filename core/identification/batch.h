#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/identification/camera_pose.h"
#include "core/identification/estimate.h"
#include "core/identification/identifiability.h"
#include "core/identification/identification_data.h"
#include "core/identification/model_discrepancy.h"
#include "core/identification/shooting.h"

namespace capstan::identification {

struct BatchOptions {
  CameraPoseOptions camera = {};
  ShootingOptions shooting = {};
  double huber = 3.37;  ///< residual of an observation beyond which it counts less: 99 % of χ with 3
  double block = 2.0;   ///< residuals this close in time may be correlated [s]
  ModelDiscrepancy discrepancy = {};
  int max_iterations = 30;
  /// Where to start: logarithms in the set's order, as the dual UKF found them; empty: nominal. From pulleys
  /// that are per cents off, through a camera that may be turned, least squares may end in another minimum.
  std::vector<double> start = {};
};

enum class BatchEnd { kConverged, kIterationLimit, kNoData, kCancelled, kFailed };

struct BatchReport {
  BatchEnd end = BatchEnd::kFailed;
  std::vector<Estimate> estimates;  ///< in the set's order
  Eigen::MatrixXd covariance;       ///< of the logarithms
  Eigen::MatrixXd correlation;      ///< of the logarithms
  CameraPose camera, camera_sigma;  ///< nuisance parameters and their standard deviations
  double delay_noise = 0.0;         ///< σ of camera.delay by noise and prior alone [s]
  Identifiability before;           ///< at the nominal parameters, before the solve
  int observations = 0;
  int iterations = 0;
  double residual_before = 0.0, residual_after = 0.0;  ///< RMS of the whitened residuals; 1: noise only
  double outliers = 0.0;  ///< share of observations that the robust loss holds back
  double seconds = 0.0;   ///< of computing
};

/// Output-error identification: the parameters and camera pose of most posterior probability,
///     min_x  Σ_k ρ(|r_k(x)|²) + |x|²,   r and x as in output_error.h, ρ Huber's loss,
/// by Levenberg–Marquardt (Ceres) with bounds. Derivatives are automatic (shooting.h).
///
/// The covariance is the larger, parameter by parameter, of two. The one is
/// H⁻¹ + H⁻¹ (Σ_d G_d G_dᵀ + G_h G_hᵀ) H⁻¹ with H = Jᵀ W J + 1, and G_d and G_h = Σ Jᵀ W D what the unknown
/// forces of ModelDiscrepancy, constant over d or against the cables' stretch rate all along, do to the
/// gradient. The other is the sandwich H⁻¹ (c Σ_b g_b g_bᵀ + 1) H⁻¹ with g_b the gradient of one of B blocks
/// of `block` seconds: what the model does not know (hysteresis, stiction) makes residuals that are
/// correlated in time (Liang and Zeger, Biometrika 73 (1986)). c = B / (B − n) with n unknowns is the usual
/// correction for few blocks, 2 at most: with fewer than 2 n the sandwich says little, and the first counts.
/// Blocks end at gaps of the motor samples. A variance is never more than the prior's. Correlations are those
/// of the one that both variances come from, else the sandwich's.
///
/// `seen` and `advice` of an estimate are by the σ that is stated; `before` is by noise alone.
BatchReport identifyBatch(const IdentificationData& data, const ParameterSet& set,
                          const BatchOptions& options = {}, base::Progress* progress = nullptr);

}  // namespace capstan::identification

template <>
struct capstan::base::NamesOf<capstan::identification::BatchEnd> {
  using E = capstan::identification::BatchEnd;
  static constexpr std::array value = {
      std::pair{E::kConverged, "converged"}, std::pair{E::kIterationLimit, "iteration limit"},
      std::pair{E::kNoData, "no camera observations"}, std::pair{E::kCancelled, "cancelled"},
      std::pair{E::kFailed, "failed"}};
};

template <>
struct capstan::base::KeysOf<capstan::identification::BatchEnd> {
  using E = capstan::identification::BatchEnd;
  static constexpr std::array value = {
      std::pair{E::kConverged, "converged"}, std::pair{E::kIterationLimit, "iteration_limit"},
      std::pair{E::kNoData, "no_camera_observations"}, std::pair{E::kCancelled, "cancelled"},
      std::pair{E::kFailed, "failed"}};
};
