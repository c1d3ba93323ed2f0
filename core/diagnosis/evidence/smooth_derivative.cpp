#include "core/diagnosis/evidence/smooth_derivative.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace capstan::diagnosis {
namespace {

/// Weights of a window's samples: row i gives the derivative at sample i, per unit of the half width.
Eigen::MatrixXd windowWeights(std::size_t length, int order) {
  const auto n = static_cast<Eigen::Index>(length);
  const Eigen::Index terms = std::min<Eigen::Index>(4, n);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  Eigen::MatrixXd powers(n, terms), slopes = Eigen::MatrixXd::Zero(n, terms);
  for (Eigen::Index p = 0; p < terms; ++p) {
    powers.col(p) = x.array().pow(static_cast<double>(p));
    const auto degree = static_cast<double>(p);
    if (order == 1 && p >= 1) slopes.col(p) = degree * x.array().pow(degree - 1.0);
    if (order == 2 && p >= 2) slopes.col(p) = degree * (degree - 1.0) * x.array().pow(degree - 2.0);
  }
  return slopes * powers.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(n, n));
}

}  // namespace

std::vector<double> smoothDerivative(std::span<const double> values, double step, std::size_t half,
                                     int order) {
  CAPSTAN_CHECK(half >= 2 && (order == 1 || order == 2) && step > 0.0);
  const std::size_t n = values.size();
  if (n < 2) return std::vector<double>(n, 0.0);
  const std::size_t length = std::min(n, 2 * half + 1), centre = length / 2;
  const double unit = 0.5 * step * static_cast<double>(length - 1);
  const Eigen::MatrixXd weights = windowWeights(length, order) / std::pow(unit, order);
  const Eigen::Map<const Eigen::VectorXd> x(values.data(), static_cast<Eigen::Index>(n));
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t begin = std::min(i - std::min(i, centre), n - length);
    const auto window = x.segment(static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(length));
    result[i] = weights.row(static_cast<Eigen::Index>(i - begin)).dot(window);
  }
  return result;
}

}  // namespace capstan::diagnosis
