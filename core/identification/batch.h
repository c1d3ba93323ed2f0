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
  ModelDiscrepancy discrepancy = {};
  /// Initial logarithms in the set's order, e.g. the dual UKF's estimates; empty: nominal. With pulley radii
  /// wrong by some per cent and a rotated camera, least squares from nominal may converge to another minimum.
  std::vector<double> start = {};
};

enum class BatchEnd { kConverged, kIterationLimit, kNoData, kCancelled, kFailed };

struct BatchReport {
  BatchEnd end = BatchEnd::kFailed;
  std::vector<Estimate> estimates;  ///< estimates in the set's order
  Eigen::MatrixXd covariance;       ///< covariance of the logarithms
  Eigen::MatrixXd correlation;      ///< correlation of the logarithms
  CameraPose camera, camera_sigma;  ///< nuisance parameters and their standard deviations
  double delay_noise = 0.0;         ///< σ of camera.delay from noise and prior alone [s]
  Identifiability before;           ///< identifiability at the nominal parameters, before the solve
  int observations = 0;
  int iterations = 0;
  double residual_before = 0.0, residual_after = 0.0;  ///< RMS of the whitened residuals; 1: noise only
  double outliers = 0.0;  ///< share of observations that the robust loss down-weights
  double seconds = 0.0;   ///< computing time [s]
};

/// Output-error identification. Returns the maximum-a-posteriori parameters and camera pose,
///     min_x  Σ_k ρ(|r_k(x)|²) + |x|²,   r and x as in output_error.h, ρ Huber's loss with limit kHuberLimit,
/// by Levenberg–Marquardt (Ceres) with bounds. Derivatives are automatic (shooting.h).
///
/// The variance of each parameter is the larger one of two covariances. The first covariance is
/// H⁻¹ + H⁻¹ (Σ_d G_d G_dᵀ + G_h G_hᵀ) H⁻¹ with H = Jᵀ W J + 1. G_d and G_h = Σ Jᵀ W D are the effects on the
/// gradient of the unknown forces of ModelDiscrepancy: G_d of a force that is constant over window d, G_h of
/// hysteresis over the whole recording. The second one is the sandwich H⁻¹ (c Σ_b g_b g_bᵀ + 1) H⁻¹, where
/// g_b is the gradient of one of B blocks of kCorrelationBlock. It covers residuals that are correlated in
/// time, because the model does not contain hysteresis or stiction (Liang and Zeger, Biometrika 73 (1986)). c
/// = B / (B − n) with n unknowns is the usual correction for few blocks, at most 2: with fewer than 2 n
/// blocks the sandwich is not reliable, and the first covariance decides. Blocks end at gaps of the motor
/// samples. No variance is above that of the prior. A correlation is that of the first covariance where both
/// variances come from it, else that of the sandwich.
///
/// `seen` and `advice` of an estimate follow from its stated σ; `before` is from noise alone.
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
