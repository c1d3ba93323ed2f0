#pragma once

#include "core/base/progress.h"
#include "core/learning/gaussian_process/kernel.h"

namespace capstan::learning {

inline constexpr double kFarthest = 12.0;

struct ProcessFitOptions {
  Kernel kernel = Kernel::kRbf;
  int iterations = 60;      ///< largest number of iterations
  double tolerance = 1e-7;  ///< relative decrease of the objective at which the search stops
  /// Largest difference of ln σ_f and ln σ_n from their start. With many features the likelihood prefers
  /// almost no noise and a signal far larger than the outputs, which overfits between the points.
  double farthest_signal = kFarthest, farthest_noise = kFarthest;
};

struct ProcessFitReport {
  KernelParameters parameters;
  double negative_log_likelihood = 0.0;
  int evaluations = 0;
  bool converged = false;
};

/// Start of a search: σ_f is the RMS of the outputs, σ_n a tenth of that, and each length-scale twice the
/// standard deviation of its feature.
KernelParameters startOf(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y,
                         const ProcessFitOptions& options);

/// Hyperparameters of maximum marginal likelihood (MarginalLikelihood) from `start`, by BFGS with line search
/// (Ceres). All stay within a factor e^kFarthest of their start, so that hyperparameters that the data do not
/// determine stay finite. When `progress` is cancelled, it stops early with the best ones so far.
ProcessFitReport fitProcess(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const KernelParameters& start,
                            const ProcessFitOptions& options = {}, const base::Progress* progress = nullptr);

}  // namespace capstan::learning
