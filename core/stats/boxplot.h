#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::stats {

/// Tukey's box plot. The quartiles are those of stats::quantile(): Hyndman and Fan's type 7, as R's
/// quantile() and NumPy compute them. MATLAB's boxplot interpolates at (k − 1/2)/n (type 5), so that its
/// boxes differ slightly for small samples.
struct Boxplot {
  std::size_t n = 0;           ///< number of samples
  double lower_whisker = 0.0;  ///< smallest sample inside the fence Q1 − 1.5 (Q3 − Q1), never inside the box
  double first_quartile = 0.0;
  double median = 0.0;
  double third_quartile = 0.0;
  double upper_whisker = 0.0;  ///< largest sample inside the fence Q3 + 1.5 (Q3 − Q1), never inside the box
  std::vector<double> outliers;  ///< samples outside the fences, in ascending order

  double interquartileRange() const { return third_quartile - first_quartile; }
};

/// Box plot of samples in any unit; the results have the same unit. `reach` ≥ 0 is the distance of the fences
/// from the box in interquartile ranges. Throws base::InputError when there are no samples, one is not
/// finite, or `reach` is not a number ≥ 0.
Boxplot boxplot(std::span<const double> values, double reach = 1.5);

}  // namespace capstan::stats
