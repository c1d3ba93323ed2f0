#include "core/learning/gaussian_process/kernel.h"

#include <cmath>

#include "core/base/check.h"
#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Computes the kernel from r², element by element, into `k`, in one pass for the RBF. Rounding may have made
/// r² negative.
template <class Squares>
void setCovariance(const KernelParameters& parameters, const Squares& squares, Eigen::Ref<Eigen::ArrayXd> k) {
  const double variance = parameters.signalVariance();
  if (parameters.kernel == Kernel::kRbf) {
    k = variance * (-0.5 * squares).min(0.0).exp();
    return;
  }
  k = (3.0 * squares.max(0.0)).sqrt();
  k = variance * (1.0 + k) * (-k).exp();
}

}  // namespace

double KernelParameters::signalVariance() const { return std::exp(2.0 * ln_signal); }
double KernelParameters::noiseVariance() const { return std::exp(2.0 * ln_noise); }

VectorXd KernelParameters::packed() const {
  VectorXd all(2 + ln_length.size());
  all << ln_signal, ln_noise, ln_length;
  return all;
}

KernelParameters KernelParameters::unpacked(const VectorXd& packed, Kernel kernel) {
  return {packed[0], packed[1], packed.tail(packed.size() - 2), kernel};
}

MatrixXd inLengths(const MatrixXd& x, const KernelParameters& parameters) {
  const VectorXd& ln = parameters.ln_length;
  CAPSTAN_CHECK(ln.size() == 1 || ln.size() == x.cols());
  if (ln.size() == 1) return std::exp(-ln[0]) * x;
  return x * (-ln.array()).exp().matrix().asDiagonal();
}

MatrixXd signalCovariance(const MatrixXd& z, const KernelParameters& parameters) {
  MatrixXd k;
  setSignalCovariance(z, parameters, k);
  return k;
}

void setSignalCovariance(const MatrixXd& z, const KernelParameters& parameters, MatrixXd& k) {
  const VectorXd squares = z.rowwise().squaredNorm();
  math::setSquare(-2.0, z, k);
  for (Index c = 0; c < k.cols(); ++c) {
    const Index n = k.rows() - c;
    auto below = k.col(c).tail(n).array();
    setCovariance(parameters, below + squares.tail(n).array() + squares[c], below);
  }
}

MatrixXd crossCovariance(const MatrixXd& a, const MatrixXd& b, const KernelParameters& parameters) {
  const VectorXd of_a = a.rowwise().squaredNorm(), of_b = b.rowwise().squaredNorm();
  MatrixXd k = math::product(a, b, true);
  for (Index c = 0; c < k.cols(); ++c) {
    auto column = k.col(c).array();
    setCovariance(parameters, of_a.array() + of_b[c] - 2.0 * column, column);
  }
  return k;
}

void timesLengthSlope(const MatrixXd& z, const KernelParameters& parameters, MatrixXd& m, MatrixXd& scratch) {
  if (parameters.kernel == Kernel::kRbf) return;
  const VectorXd squares = z.rowwise().squaredNorm();
  math::setSquare(-2.0, z, scratch);
  for (Index c = 0; c < m.cols(); ++c) {
    const Index n = m.rows() - c;
    const Eigen::ArrayXd r2 =
        (scratch.col(c).tail(n).array() + squares.tail(n).array() + squares[c]).max(0.0);
    m.col(c).tail(n).array() *= 3.0 / (1.0 + (3.0 * r2).sqrt());
  }
}

}  // namespace capstan::learning
