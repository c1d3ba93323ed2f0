#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace capstan::stats {

/// Tukey's box plot. Quartiles are stats::quantile's: Hyndman and Fan's type 7, as R's quantile() and NumPy
/// give them; MATLAB's boxplot interpolates at (k − 1/2)/n (type 5), so its boxes differ a little in small
/// samples.
struct Boxplot {
  std::size_t n = 0;
  double lower_whisker = 0.0;  ///< smallest sample inside the fence Q1 − 1.5 (Q3 − Q1), never inside the box
  double first_quartile = 0.0;
  double median = 0.0;
  double third_quartile = 0.0;
  double upper_whisker = 0.0;  ///< largest sample inside the fence Q3 + 1.5 (Q3 − Q1), never inside the box
  std::vector<double> outliers;  ///< the samples outside the fences, ascending

  double interquartileRange() const { return third_quartile - first_quartile; }
};

/// Of samples in any unit, results in the same; `reach` is the fences' distance from the box in interquartile
/// ranges, ≥ 0. base::InputError: no samples, one that is not finite, or a reach that is not a number ≥ 0.
Boxplot boxplot(std::span<const double> values, double reach = 1.5);

}  // namespace capstan::stats
