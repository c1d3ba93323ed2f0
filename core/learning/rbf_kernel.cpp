#include "core/learning/rbf_kernel.h"

#include <cassert>
#include <cmath>

#include "core/math/dense.h"

namespace capstan::learning {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double RbfParameters::signalVariance() const { return std::exp(2.0 * ln_signal); }
double RbfParameters::noiseVariance() const { return std::exp(2.0 * ln_noise); }

VectorXd RbfParameters::packed() const {
  VectorXd all(2 + ln_length.size());
  all << ln_signal, ln_noise, ln_length;
  return all;
}

RbfParameters RbfParameters::unpacked(const VectorXd& packed) {
  return {packed[0], packed[1], packed.tail(packed.size() - 2)};
}

MatrixXd inLengths(const MatrixXd& x, const RbfParameters& parameters) {
  const VectorXd& ln = parameters.ln_length;
  assert(ln.size() == 1 || ln.size() == x.cols());
  if (ln.size() == 1) return std::exp(-ln[0]) * x;
  return x * (-ln.array()).exp().matrix().asDiagonal();
}

MatrixXd signalCovariance(const MatrixXd& z, const RbfParameters& parameters) {
  const VectorXd squares = z.rowwise().squaredNorm();
  MatrixXd k = MatrixXd::Zero(z.rows(), z.rows());
  math::addSquare(1.0, z, k);
  const double variance = parameters.signalVariance();
  for (Index c = 0; c < k.cols(); ++c) {
    const Index n = k.rows() - c;
    auto below = k.col(c).tail(n).array();
    below = variance * (below - 0.5 * (squares.tail(n).array() + squares[c])).min(0.0).exp();
  }
  return k;
}

MatrixXd crossCovariance(const MatrixXd& a, const MatrixXd& b, const RbfParameters& parameters) {
  const VectorXd of_a = a.rowwise().squaredNorm(), of_b = b.rowwise().squaredNorm();
  MatrixXd k = math::product(a, b, true);
  const double variance = parameters.signalVariance();
  for (Index c = 0; c < k.cols(); ++c)
    k.col(c) = variance * (k.col(c).array() - 0.5 * (of_a.array() + of_b[c])).min(0.0).exp();
  return k;
}

}  // namespace capstan::learning
