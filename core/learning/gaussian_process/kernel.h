#pragma once

#include <Eigen/Core>

#include "core/base/names.h"

/// Kernels with one length-scale, or one a feature (automatic relevance determination), under white noise
/// (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, (5.1)), of the distance in lengths
/// r² = Σ_i (a_i − b_i)² / ℓ_i². Points are rows, features are columns.
namespace capstan::learning {

enum class Kernel {
  kRbf,     ///< σ_f² exp(−½ r²), of functions smooth without end: GPR paper, section IV-C
  kMatern,  ///< of order 3/2, (4.17): σ_f² (1 + √3 r) exp(−√3 r), once differentiable: joints that stick
};

/// Logarithms of what a kernel has to learn.
struct KernelParameters {
  double ln_signal = 0.0;     ///< ln σ_f
  double ln_noise = -2.0;     ///< ln σ_n
  Eigen::VectorXd ln_length;  ///< ln ℓ, one of all features or one each
  Kernel kernel = Kernel::kRbf;

  double signalVariance() const;
  double noiseVariance() const;
  /// [ln σ_f, ln σ_n, ln ℓ…]
  Eigen::VectorXd packed() const;
  static KernelParameters unpacked(const Eigen::VectorXd& packed, Kernel kernel);
};

/// Features in length-scales: x_i / ℓ_i.
Eigen::MatrixXd inLengths(const Eigen::MatrixXd& x, const KernelParameters& parameters);

/// Of each row of z = inLengths(x) with each: the lower triangle, the rest undefined.
Eigen::MatrixXd signalCovariance(const Eigen::MatrixXd& z, const KernelParameters& parameters);
/// The same into `k`, whose memory is used again where it has that size.
void setSignalCovariance(const Eigen::MatrixXd& z, const KernelParameters& parameters, Eigen::MatrixXd& k);

/// Likewise of each row of a with each row of b.
Eigen::MatrixXd crossCovariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const KernelParameters& parameters);

/// M ← M ∘ ρ, lower triangle, of rows of z: ∂k/∂ln ℓ_i = ρ k (z_ri − z_ci)²; ρ is 1 of the RBF and
/// 3 / (1 + √3 r) of the Matérn kernel. What was in `scratch` is lost, its memory used again.
void timesLengthSlope(const Eigen::MatrixXd& z, const KernelParameters& parameters, Eigen::MatrixXd& m,
                      Eigen::MatrixXd& scratch);

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::Kernel> {
  using K = capstan::learning::Kernel;
  static constexpr std::array value = {std::pair{K::kRbf, "rbf"}, std::pair{K::kMatern, "matern"}};
};
