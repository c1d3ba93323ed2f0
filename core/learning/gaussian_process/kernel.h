#pragma once

#include <Eigen/Core>

#include "core/base/names.h"

/// Kernels with a common length-scale or one per feature (automatic relevance determination), plus white
/// noise (Rasmussen and Williams, Gaussian Processes for Machine Learning, 2006, (5.1)). They depend on the
/// scaled distance r² = Σ_i (a_i − b_i)² / ℓ_i². Points are rows, features are columns.
namespace capstan::learning {

enum class Kernel {
  kRbf,  ///< σ_f² exp(−½ r²), for infinitely smooth functions: GPR paper, section IV-C
  kMatern,  ///< order 3/2, (4.17): σ_f² (1 + √3 r) exp(−√3 r), once differentiable, for joints with stiction
};

/// Hyperparameters of a kernel as logarithms.
struct KernelParameters {
  double ln_signal = 0.0;     ///< ln σ_f
  double ln_noise = -2.0;     ///< ln σ_n
  Eigen::VectorXd ln_length;  ///< ln ℓ, one for all features or one per feature
  Kernel kernel = Kernel::kRbf;

  double signalVariance() const;
  double noiseVariance() const;
  /// Vector [ln σ_f, ln σ_n, ln ℓ…].
  Eigen::VectorXd packed() const;
  static KernelParameters unpacked(const Eigen::VectorXd& packed, Kernel kernel);
};

/// Features divided by their length-scales: x_i / ℓ_i.
Eigen::MatrixXd inLengths(const Eigen::MatrixXd& x, const KernelParameters& parameters);

/// Covariance of all pairs of rows of z = inLengths(x): lower triangle; the other elements are undefined.
Eigen::MatrixXd signalCovariance(const Eigen::MatrixXd& z, const KernelParameters& parameters);
/// Writes signalCovariance() into `k`; its memory is reused if it has that size.
void setSignalCovariance(const Eigen::MatrixXd& z, const KernelParameters& parameters, Eigen::MatrixXd& k);

/// Covariance of each row of a with each row of b, both in length-scales.
Eigen::MatrixXd crossCovariance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const KernelParameters& parameters);

/// Computes M ← M ∘ ρ (lower triangle) for rows of z, where ∂k/∂ln ℓ_i = ρ k (z_ri − z_ci)². ρ is 1 for the
/// RBF kernel and 3 / (1 + √3 r) for the Matérn kernel. `scratch` is overwritten, its memory reused.
void timesLengthSlope(const Eigen::MatrixXd& z, const KernelParameters& parameters, Eigen::MatrixXd& m,
                      Eigen::MatrixXd& scratch);

}  // namespace capstan::learning

template <>
struct capstan::base::NamesOf<capstan::learning::Kernel> {
  using K = capstan::learning::Kernel;
  static constexpr std::array value = {std::pair{K::kRbf, "rbf"}, std::pair{K::kMatern, "matern"}};
};
