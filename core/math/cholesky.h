#pragma once

#include <Eigen/Core>
#include <cmath>

namespace capstan::math {

/// Rank-one update L ← chol(L Lᵀ + x xᵀ) in place, by Givens rotations; L is lower triangular, N×N, with
/// diagonal >= 0. It cannot fail.
template <class Lower>
void rankOneUpdate(Lower& l, Eigen::Matrix<double, Lower::RowsAtCompileTime, 1> x) {
  constexpr int kSize = Lower::RowsAtCompileTime;
  for (int k = 0; k < kSize; ++k) {
    const double r = std::hypot(l(k, k), x(k));
    if (r == 0.0) continue;
    const double c = l(k, k) / r, s = x(k) / r;
    l(k, k) = r;
    for (int i = k + 1; i < kSize; ++i) {
      const double below = l(i, k);
      l(i, k) = c * below + s * x(i);
      x(i) = c * x(i) - s * below;
    }
  }
}

/// Rank-one down-date L ← chol(L Lᵀ − x xᵀ) as in LINPACK's dchdd, by rotations from the last row up. Returns
/// false and leaves L unchanged when the difference is not safely positive definite (1 − |L⁻¹x|² below 1e-14,
/// or a number is not finite).
template <class Lower>
[[nodiscard]] bool rankOneDowndate(Lower& l, const Eigen::Matrix<double, Lower::RowsAtCompileTime, 1>& x) {
  constexpr int kSize = Lower::RowsAtCompileTime;
  constexpr double kSafe = 1e-14;
  Eigen::Matrix<double, kSize, 1> p;  // L p = x
  double rest = 1.0;
  for (int i = 0; i < kSize; ++i) {
    double sum = x(i);
    for (int j = 0; j < i; ++j) sum -= l(i, j) * p(j);
    if (l(i, i) == 0.0) return false;
    p(i) = sum / l(i, i);
    rest -= p(i) * p(i);
  }
  if (!(rest > kSafe)) return false;

  double alpha = std::sqrt(rest);
  Eigen::Matrix<double, kSize, 1> c, s;
  for (int k = kSize - 1; k >= 0; --k) {
    const double r = std::hypot(alpha, p(k));
    c(k) = alpha / r;
    s(k) = p(k) / r;
    alpha = r;
  }
  for (int i = 0; i < kSize; ++i) {
    double carried = 0.0;
    for (int k = i; k >= 0; --k) {
      const double before = l(i, k);
      l(i, k) = c(k) * before - s(k) * carried;
      carried = c(k) * carried + s(k) * before;
    }
  }
  return true;
}

}  // namespace capstan::math
