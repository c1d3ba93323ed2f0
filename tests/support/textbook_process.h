#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/random.h"
#include "core/learning/gaussian_process/kernel.h"

/// Test data for Gaussian processes, and the formulas of their textbook (Rasmussen and Williams 2006).
namespace capstan::testing {

using learning::Kernel, learning::KernelParameters;

struct Sample {
  Eigen::MatrixXd x, y;
};

/// Points in three dimensions, and smooth noisy outputs that do not depend on the third dimension.
inline Sample sample(Eigen::Index n, Eigen::Index outputs, double noise, std::uint64_t seed = 1) {
  base::Random random(seed, "process test");
  Sample s{Eigen::MatrixXd(n, 3), Eigen::MatrixXd(n, outputs)};
  for (Eigen::Index r = 0; r < n; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c) s.x(r, c) = random.uniform(-2.0, 2.0);
    for (Eigen::Index c = 0; c < outputs; ++c)
      s.y(r, c) = std::sin(1.3 * s.x(r, 0) + static_cast<double>(c)) * std::cos(0.7 * s.x(r, 1)) +
                  random.normal(0.0, noise);
  }
  return s;
}

inline constexpr std::array kKernels = {Kernel::kRbf, Kernel::kMatern};

inline KernelParameters someParameters(bool ard, Kernel kernel = Kernel::kRbf) {
  KernelParameters p{0.2, -1.4, {}, kernel};
  if (ard)
    p.ln_length = Eigen::Vector3d(-0.1, 0.4, 1.1);
  else
    p.ln_length = Eigen::VectorXd::Constant(1, 0.3);
  return p;
}

/// Kernel (5.1) or (4.17) of two points, element by element.
inline double kernel(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const KernelParameters& p) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    const double length = std::exp(p.ln_length[p.ln_length.size() == 1 ? 0 : i]);
    sum += std::pow((a[i] - b[i]) / length, 2);
  }
  const double variance = std::exp(2.0 * p.ln_signal), r = std::sqrt(sum);
  if (p.kernel == Kernel::kRbf) return variance * std::exp(-0.5 * r * r);
  return variance * (1.0 + std::sqrt(3.0) * r) * std::exp(-std::sqrt(3.0) * r);
}

inline Eigen::MatrixXd kernels(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                               const KernelParameters& p) {
  Eigen::MatrixXd k(a.rows(), b.rows());
  for (Eigen::Index r = 0; r < k.rows(); ++r)
    for (Eigen::Index c = 0; c < k.cols(); ++c) k(r, c) = kernel(a.row(r), b.row(c), p);
  return k;
}

inline Eigen::MatrixXd noisy(const Eigen::MatrixXd& x, const KernelParameters& p) {
  return kernels(x, x, p) + p.noiseVariance() * Eigen::MatrixXd::Identity(x.rows(), x.rows());
}

}  // namespace capstan::testing
