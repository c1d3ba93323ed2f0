#pragma once

#include "core/base/progress.h"
#include "core/learning/gaussian_process/kernel.h"

namespace capstan::learning {

inline constexpr double kFarthest = 12.0;

struct ProcessFitOptions {
  Kernel kernel = Kernel::kRbf;
  int iterations = 60;      ///< of the search, at most
  double tolerance = 1e-7;  ///< relative fall of the objective that counts as standing still
  /// How far ln σ_f and ln σ_n may go from the start's: many features make next to no noise, and signals far
  /// beyond the outputs, likely between points and wrong elsewhere.
  double farthest_signal = kFarthest, farthest_noise = kFarthest;
};

struct ProcessFitReport {
  KernelParameters parameters;
  double negative_log_likelihood = 0.0;
  int evaluations = 0;
  bool converged = false;
};

/// Where a search may begin: the signal as large as the outputs, a tenth of it noise, lengths of a few
/// deviations of each feature.
KernelParameters startOf(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y,
                         const ProcessFitOptions& options);

/// Hyperparameters of maximum marginal likelihood (MarginalLikelihood) from `start`, by BFGS with line
/// search (Ceres). All stay within e^kFarthest of the start's, so that what the data leave open stays finite.
/// Stops early when `progress` is cancelled, with the best so far.
ProcessFitReport fitProcess(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const KernelParameters& start,
                            const ProcessFitOptions& options = {}, const base::Progress* progress = nullptr);

}  // namespace capstan::learning
