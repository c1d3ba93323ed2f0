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

/// Exponent e with |x| < 2^e for all samples.
int exponentOf(std::span<const double> values) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

/// Mean of the samples scaled by 2^−exponent; a second pass adds the mean of what the first one's rounding
/// left.
double scaledMean(std::span<const double> values, int exponent) {
  const auto n = static_cast<double>(values.size());
  Sum sum;
  for (const double x : values) sum.add(std::ldexp(x, -exponent));
  const double first = sum.value() / n;
  Sum rest;
  for (const double x : values) rest.add(std::ldexp(x, -exponent) - first);
  return first + rest.value() / n;
}

/// Standard deviation of samples about `scaled_mean`, both scaled by 2^−exponent; deviations are scaled up
/// again by their own largest one, for they may be far smaller than the mean.
double scaledDeviation(std::span<const double> values, int exponent, double scaled_mean) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(std::ldexp(x, -exponent) - scaled_mean));
  int own = 0;
  std::frexp(largest, &own);
  Sum squares;
  Sum deviations;
  for (const double x : values) {
    const double d = std::ldexp(std::ldexp(x, -exponent) - scaled_mean, -own);
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
  Sum squares;
  for (const double x : values) {
    const double scaled = std::ldexp(x, -exponent);
    squares.add(scaled * scaled);
  }
  return std::ldexp(std::sqrt(squares.value() / static_cast<double>(values.size())), exponent);
}

double mean(std::span<const double> values) {
  requireSamples(values, 1, "mean");
  const int exponent = exponentOf(values);
  return std::ldexp(scaledMean(values, exponent), exponent);
}

double standardDeviation(std::span<const double> values) {
  requireSamples(values, 2, "standard deviation");
  const int exponent = exponentOf(values);
  return std::ldexp(scaledDeviation(values, exponent, scaledMean(values, exponent)), exponent);
}

double variance(std::span<const double> values) {
  const double deviation = standardDeviation(values);
  return deviation * deviation;
}

Moments moments(std::span<const double> values) {
  requireSamples(values, 2, "moments");
  const int exponent = exponentOf(values);
  const double scaled = scaledMean(values, exponent);
  const double deviation = std::ldexp(scaledDeviation(values, exponent, scaled), exponent);
  return {values.size(), std::ldexp(scaled, exponent), deviation * deviation};
}

}  // namespace capstan::stats
