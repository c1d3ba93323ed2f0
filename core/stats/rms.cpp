#include "core/stats/rms.h"

#include <algorithm>
#include <cmath>

#include "core/stats/samples.h"

namespace capstan::stats {
namespace {

/// Neumaier's compensated sum.
class Sum {
 public:
  void add(double x) {
    const double total = total_ + x;
    lost_ += std::abs(total_) >= std::abs(x) ? (total_ - total) + x : (x - total) + total_;
    total_ = total;
  }
  double value() const { return total_ + lost_; }

 private:
  double total_ = 0.0;
  double lost_ = 0.0;
};

/// Exponent e such that |x| < 2^e for all samples and 2^−e is a finite double.
int exponentOf(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::max(exponent, -1021);
}

int exponentOf(std::span<const double> values) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  return exponentOf(largest);
}

/// Mean of the samples times `scale`. A second pass adds the mean of the rounding errors of the first pass.
double scaledMean(std::span<const double> values, double scale) {
  const auto n = static_cast<double>(values.size());
  Sum sum;
  for (const double x : values) sum.add(x * scale);
  const double first = sum.value() / n;
  Sum rest;
  for (const double x : values) rest.add(x * scale - first);
  return first + rest.value() / n;
}

/// Standard deviation of the samples times `scale` about `scaled_mean`. The deviations are scaled again by
/// the largest of them, because they may be far smaller than the mean.
double scaledDeviation(std::span<const double> values, double scale, double scaled_mean) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x * scale - scaled_mean));
  const int own = exponentOf(largest);
  const double own_scale = std::ldexp(1.0, -own);
  Sum squares;
  Sum deviations;
  for (const double x : values) {
    const double d = (x * scale - scaled_mean) * own_scale;
    squares.add(d * d);
    deviations.add(d);
  }
  const auto n = static_cast<double>(values.size());
  const double of_deviations = std::max(0.0, squares.value() - deviations.value() * deviations.value() / n);
  return std::ldexp(std::sqrt(of_deviations / (n - 1.0)), own);
}

}  // namespace

double Moments::standardDeviation() const { return std::sqrt(variance); }

double rms(std::span<const double> values) {
  requireSamples(values, 1, "rms");
  const int exponent = exponentOf(values);
  const double scale = std::ldexp(1.0, -exponent);
  Sum squares;
  for (const double x : values) squares.add(x * scale * (x * scale));
  return std::ldexp(std::sqrt(squares.value() / static_cast<double>(values.size())), exponent);
}

double mean(std::span<const double> values) {
  requireSamples(values, 1, "mean");
  const int exponent = exponentOf(values);
  return std::ldexp(scaledMean(values, std::ldexp(1.0, -exponent)), exponent);
}

double standardDeviation(std::span<const double> values) {
  requireSamples(values, 2, "standard deviation");
  const int exponent = exponentOf(values);
  const double scale = std::ldexp(1.0, -exponent);
  return std::ldexp(scaledDeviation(values, scale, scaledMean(values, scale)), exponent);
}

double variance(std::span<const double> values) {
  const double deviation = standardDeviation(values);
  return deviation * deviation;
}

Moments moments(std::span<const double> values) {
  requireSamples(values, 2, "moments");
  const int exponent = exponentOf(values);
  const double scale = std::ldexp(1.0, -exponent);
  const double scaled = scaledMean(values, scale);
  const double deviation = std::ldexp(scaledDeviation(values, scale, scaled), exponent);
  return {values.size(), std::ldexp(scaled, exponent), deviation * deviation};
}

}  // namespace capstan::stats
