#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/progress.h"

namespace capstan::diagnosis {

/// Points of d variables: n×d, each variable of about unit spread; angles [rad] as they are.
struct ProcessInputs {
  Eigen::VectorXd t;  ///< when [s]
  Eigen::MatrixXd x;
  std::vector<bool> angle;  ///< of each variable: the same after a rotation

  Eigen::Index size() const { return x.rows(); }
  Eigen::Index variables() const { return x.cols(); }
};

/// Squared distance of two values: (a − b)², of angles that of the points on the unit circle, 4 sin²((a −
/// b)/2).
double squaredDistance(double a, double b, bool angle);

/// Logarithms of what the process has to learn: [ln σ_f, ln σ_n, ln σ_c, ln τ, ln ℓ_1 … ln ℓ_d].
using ProcessParameters = Eigen::VectorXd;
inline constexpr Eigen::Index kSignal = 0, kWhite = 1, kSlow = 2, kMemory = 3, kLengths = 4;

/// Gaussian process with automatic relevance determination (Rasmussen and Williams, Gaussian Processes for
/// Machine Learning, 2006, (5.1)) under noise that has a memory (Ornstein and Uhlenbeck, their (4.18) with
/// ν = 1/2),
///     k = σ_f² exp(−½ Σ_i D_i(x, x') / ℓ_i²) + σ_c² exp(−|t − t'| / τ) + σ_n² δ,
/// D_i the squared distance of variable i, of targets y with mean 0 and variance 1. Without the noise's
/// memory what merely lasts a while would seem to depend on whatever is slow.
class ArdProcess {
 public:
  ArdProcess(const ProcessInputs& inputs, Eigen::VectorXd y);

  /// −ln p(y | x, θ) − ln p(θ), (2.30) and its gradient (5.9); the prior is normal and wide: ln σ_f about 0,
  /// ln σ_n and ln σ_c about ln 0.3 with deviation 2, ln τ about ln 0.3 (seconds) and ln ℓ about ln 4 with
  /// deviation 1.5. It keeps what the data leave open finite. Nothing where K is not positive definite.
  std::optional<double> objective(const ProcessParameters& parameters, Eigen::VectorXd* gradient) const;

  /// Least objective from `start` by BFGS with line search (Ceres), at most `iterations`; `start` itself
  /// where nothing better is found. Stops early when `progress` is cancelled.
  ProcessParameters fit(const ProcessParameters& start, int iterations, const base::Progress* progress) const;

  /// Weights α = K⁻¹ y of the predictions Σ_n α_n σ_f² exp(−½ Σ_i D_i(x, x_n) / ℓ_i²), what the variables
  /// predict without the noise; zero where K is not positive definite.
  Eigen::VectorXd weights(const ProcessParameters& parameters) const;

  Eigen::Index parameters() const { return kLengths + static_cast<Eigen::Index>(distances_.size()); }

 private:
  Eigen::MatrixXd signalCovariance(const ProcessParameters& parameters) const;
  Eigen::MatrixXd slowCovariance(const ProcessParameters& parameters) const;

  Eigen::MatrixXd apart_;                   ///< |t − t'| [s]
  std::vector<Eigen::MatrixXd> distances_;  ///< D_i
  Eigen::VectorXd y_;
};

/// Σ_i D_i(a_r, b_c) / ℓ_i²: rows of `at` by rows of `known`.
Eigen::MatrixXd scaledDistances(const ProcessInputs& at, const ProcessInputs& known,
                                const ProcessParameters& parameters);

}  // namespace capstan::diagnosis
