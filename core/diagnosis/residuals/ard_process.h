#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/base/progress.h"

namespace capstan::diagnosis {

/// Inputs of the process: n points of d variables, x is n×d. Each variable is scaled to about unit spread;
/// angles stay in rad.
struct ProcessInputs {
  Eigen::VectorXd t;  ///< time of each point [s]
  Eigen::MatrixXd x;
  std::vector<bool> angle;  ///< true for variables with the period 2π

  Eigen::Index size() const { return x.rows(); }
  Eigen::Index variables() const { return x.cols(); }
};

/// Squared distance of two values: (a − b)²; for angles that of the points on the unit circle,
/// 4 sin²((a − b)/2).
double squaredDistance(double a, double b, bool angle);

/// Logarithms of the hyperparameters: [ln σ_f, ln σ_n, ln σ_c, ln τ, ln ℓ_1 … ln ℓ_d].
using ProcessParameters = Eigen::VectorXd;
inline constexpr Eigen::Index kSignal = 0, kWhite = 1, kSlow = 2, kMemory = 3, kLengths = 4;

/// Gaussian process with automatic relevance determination (Rasmussen and Williams, Gaussian Processes for
/// Machine Learning, 2006, (5.1)) with white and with correlated noise (Ornstein–Uhlenbeck process, their
/// (4.18) with ν = 1/2),
///     k = σ_f² exp(−½ Σ_i D_i(x, x') / ℓ_i²) + σ_c² exp(−|t − t'| / τ) + σ_n² δ,
/// where D_i is the squared distance of variable i. Targets y have mean 0 and variance 1. Without the
/// correlated noise, every slow disturbance would appear to depend on the slow variables.
class ArdProcess {
 public:
  ArdProcess(const ProcessInputs& inputs, Eigen::VectorXd y);

  /// −ln p(y | x, θ) − ln p(θ), (2.30), and its gradient (5.9). The prior is normal: ln σ_f with mean 0,
  /// ln σ_n and ln σ_c with mean ln 0.3, all three with deviation 2; ln τ with mean ln 0.3 (τ in s) and ln ℓ
  /// with mean ln 4, with deviation 1.5. The wide prior keeps hyperparameters finite that the data do not
  /// determine. Returns nothing if K is not positive definite.
  std::optional<double> objective(const ProcessParameters& parameters, Eigen::VectorXd* gradient) const;

  /// Minimizes the objective from `start` by BFGS with line search (Ceres) in at most `iterations`. Returns
  /// `start` if nothing better is found. Stops early if `progress` is cancelled.
  ProcessParameters fit(const ProcessParameters& start, int iterations, const base::Progress* progress) const;

  /// Weights α = K⁻¹ y. The prediction from the variables alone is Σ_n α_n σ_f² exp(−½ Σ_i D_i(x, x_n) /
  /// ℓ_i²). Returns zeros if K is not positive definite.
  Eigen::VectorXd weights(const ProcessParameters& parameters) const;

  Eigen::Index parameters() const { return kLengths + static_cast<Eigen::Index>(distances_.size()); }

 private:
  Eigen::MatrixXd signalCovariance(const ProcessParameters& parameters) const;
  Eigen::MatrixXd slowCovariance(const ProcessParameters& parameters) const;

  Eigen::MatrixXd apart_;                   ///< |t − t'| [s]
  std::vector<Eigen::MatrixXd> distances_;  ///< D_i
  Eigen::VectorXd y_;
};

/// Scaled squared distances Σ_i D_i(a_r, b_c) / ℓ_i² between the rows a_r of `at` and b_c of `known`.
Eigen::MatrixXd scaledDistances(const ProcessInputs& at, const ProcessInputs& known,
                                const ProcessParameters& parameters);

}  // namespace capstan::diagnosis
