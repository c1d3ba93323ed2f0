#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/estimation/square_root_ukf.h"

namespace capstan::estimation {

/// Closed interval for a mean.
struct Band {
  double low = 0.0;
  double high = 0.0;
  bool contains(double value) const { return value >= low && value <= high; }  // NaN: no
};

/// Where the mean of `count` independent chi-square values of `dof` degrees of freedom, divided by dof, lies
/// with probability `confidence`: chi-square quantiles of count·dof over count·dof (Bar-Shalom, Li and
/// Kirubarajan 2001, section 5.4). It is 1 ± 1.96 √(2 / (count dof)) for many; a band for a mean, not for a
/// single value.
Band chiSquareBand(int dof, std::int64_t count, double confidence = 0.95);

/// Normalised estimation error squared, eᵀ (S Sᵀ)⁻¹ e with e = estimate − truth; chi-square with N degrees of
/// freedom.
template <int N>
double nees(const Eigen::Matrix<double, N, 1>& error, const Lower<N>& root) {
  return detail::solveLower<N>(root, error).squaredNorm();
}

/// Running mean of NIS or NEES over the last `window` values, with the band that it should lie in. No
/// allocation after construction.
class ConsistencyWindow {
 public:
  ConsistencyWindow(int dof, int window, double confidence = 0.95);

  /// Takes one value; non-finite ones are excluded.
  void add(double value);
  void reset();

  int count() const { return count_; }
  /// Mean divided by dof: 1 for a consistent filter; NaN before the first value.
  double mean() const;
  /// Of mean(), for the present count; 0 … infinity before the first value.
  Band band() const;
  bool consistent() const { return count_ == 0 || band().contains(mean()); }

 private:
  int dof_;
  std::vector<double> values_;
  std::vector<Band> bands_;  ///< by count − 1
  int count_ = 0;
  int next_ = 0;
  double sum_ = 0.0;
};

}  // namespace capstan::estimation
