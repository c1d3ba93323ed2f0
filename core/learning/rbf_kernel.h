#pragma once

#include <Eigen/Core>

/// Radial basis functions with one length-scale, or one a feature (automatic relevance determination), under
/// white noise (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, (5.1)):
///     k(a, b) = σ_f² exp(−½ Σ_i (a_i − b_i)² / ℓ_i²) + σ_n² δ_ab
/// GPR paper, section IV-C. Points are rows, features are columns.
namespace capstan::learning {

/// Logarithms of what the kernel has to learn.
struct RbfParameters {
  double ln_signal = 0.0;     ///< ln σ_f
  double ln_noise = -2.0;     ///< ln σ_n
  Eigen::VectorXd ln_length;  ///< ln ℓ, one of all features or one each

  double signalVariance() const;
  double noiseVariance() const;
  /// [ln σ_f, ln σ_n, ln ℓ…]
  Eigen::VectorXd packed() const;
  static RbfParameters unpacked(const Eigen::VectorXd& packed);
};

/// Features in length-scales: x_i / ℓ_i.
Eigen::MatrixXd inLengths(const Eigen::MatrixXd& x, const RbfParameters& parameters);

/// σ_f² exp(−½ |z_r − z_c|²) of the rows of z = inLengths(x): the lower triangle, the rest undefined.
Eigen::MatrixXd signalCovariance(const Eigen::MatrixXd& z, const RbfParameters& parameters);

/// Likewise of each row of a with each row of b.
Eigen::MatrixXd crossCovariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const RbfParameters& parameters);

}  // namespace capstan::learning
