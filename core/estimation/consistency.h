#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/estimation/square_root_ukf.h"

namespace capstan::estimation {

/// Closed interval in which a mean is expected.
struct Band {
  double low = 0.0;
  double high = 0.0;
  bool contains(double value) const { return value >= low && value <= high; }  // false for NaN
};

/// Band that contains, with probability `confidence`, the mean of `count` independent chi-square values of
/// `dof` degrees of freedom, divided by dof: chi-square quantiles with count·dof degrees of freedom over
/// count·dof (Bar-Shalom, Li and Kirubarajan 2001, section 5.4). For a large count it is about 1 ± 1.96 √(2 /
/// (count dof)) at 95 %. The band is for a mean, not for a single value.
Band chiSquareBand(int dof, std::int64_t count, double confidence = 0.95);

/// Normalised estimation error squared (NEES), eᵀ (S Sᵀ)⁻¹ e with e = estimate − truth and S = `root`. It has
/// a chi-square distribution with N degrees of freedom.
template <int N>
double nees(const Eigen::Matrix<double, N, 1>& error, const Lower<N>& root) {
  return detail::solveLower<N>(root, error).squaredNorm();
}

/// Running mean of NIS or NEES over the last `window` values, with its chi-square band. No allocation after
/// construction.
class ConsistencyWindow {
 public:
  ConsistencyWindow(int dof, int window, double confidence = 0.95);

  /// Adds one value; a non-finite value is excluded.
  void add(double value);
  void reset();

  int count() const { return count_; }
  /// Mean divided by dof: 1 for a consistent filter; NaN before the first value.
  double mean() const;
  /// Band of mean() for the present count; 0 … infinity before the first value.
  Band band() const;
  bool consistent() const { return count_ == 0 || band().contains(mean()); }

 private:
  int dof_;
  std::vector<double> values_;
  std::vector<Band> bands_;  ///< bands by index count − 1
  int count_ = 0;
  int next_ = 0;
  double sum_ = 0.0;
};

}  // namespace capstan::estimation
