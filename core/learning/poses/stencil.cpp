#include "core/learning/poses/stencil.h"

#include <algorithm>

#include "core/base/check.h"
#include "core/learning/poses/rotation_vector.h"

namespace capstan::learning {
namespace {

/// Index of the first stamp in the stencil of stamp k.
std::size_t firstAround(std::size_t k, std::size_t size) {
  const std::size_t width = std::min(kStencil, size);
  return std::min(k - std::min(k, width / 2), size - width);
}

}  // namespace

std::vector<double> derivativeWeights(std::span<const double> t, double at) {
  const std::size_t n = t.size();
  std::vector<double> weights(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {  // derivative of Lagrange's polynomial k
    double scale = 1.0;
    for (std::size_t i = 0; i < n; ++i)
      if (i != k) scale *= t[k] - t[i];
    for (std::size_t excluded = 0; excluded < n; ++excluded) {
      if (excluded == k) continue;
      double product = 1.0;
      for (std::size_t i = 0; i < n; ++i)
        if (i != k && i != excluded) product *= at - t[i];
      weights[k] += product / scale;
    }
  }
  return weights;
}

Eigen::Matrix3Xd velocitiesOf(std::span<const double> t, const Eigen::Matrix3Xd& positions) {
  CAPSTAN_CHECK(static_cast<Eigen::Index>(t.size()) == positions.cols());
  Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, positions.cols());
  for (std::size_t k = 0; k < t.size() && t.size() > 1; ++k) {
    const std::size_t first = firstAround(k, t.size()), width = std::min(kStencil, t.size());
    const std::vector<double> weights = derivativeWeights(t.subspan(first, width), t[k]);
    for (std::size_t i = 0; i < width; ++i)
      velocities.col(static_cast<Eigen::Index>(k)) +=
          weights[i] * positions.col(static_cast<Eigen::Index>(first + i));
  }
  return velocities;
}

Eigen::Matrix3Xd angularVelocitiesOf(std::span<const double> t, std::span<const Eigen::Quaterniond> turns) {
  CAPSTAN_CHECK(t.size() == turns.size());
  Eigen::Matrix3Xd velocities = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(t.size()));
  for (std::size_t k = 0; k < t.size() && t.size() > 1; ++k) {
    const std::size_t first = firstAround(k, t.size()), width = std::min(kStencil, t.size());
    const std::vector<double> weights = derivativeWeights(t.subspan(first, width), t[k]);
    for (std::size_t i = 0; i < width; ++i)
      velocities.col(static_cast<Eigen::Index>(k)) +=
          weights[i] * rotationVector(turns[k].conjugate() * turns[first + i]);
  }
  return velocities;
}

}  // namespace capstan::learning
