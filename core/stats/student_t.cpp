#include "core/stats/student_t.h"

#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>
#include <limits>

#include "core/base/check.h"

namespace capstan::stats {
namespace {

/// Continued fraction 1/(1+) d1/(1+) d2/(1+) … of I_x(a, b) by Lentz's method, modified by Thompson and
/// Barnett (1986). It converges fast for x < (a + 1)/(a + b + 2), as in the far tails of t.
double incompleteBetaFraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300;
  constexpr int kMostTerms = 100000;
  const auto away = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1.0;
  double d = 1.0 / away(1.0 - (a + b) * x / (a + 1.0));
  double fraction = d;
  for (int m = 1; m < kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
    d = 1.0 / away(1.0 + even * d);
    c = away(1.0 + even / c);
    fraction *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
    d = 1.0 / away(1.0 + odd * d);
    c = away(1.0 + odd / c);
    fraction *= c * d;
    if (std::abs(c * d - 1.0) < std::numeric_limits<double>::epsilon()) break;
  }
  return fraction;
}

/// ln I_x(a, 1/2) = a ln x + ½ ln(1 − x) − ln(a B(a, 1/2)) + ln(fraction), with r = |t|/√ν and x = 1/(1 +
/// r²).
double logTail(double t, double nu) {
  const double a = nu / 2.0;
  const double r = std::abs(t) / std::sqrt(nu);
  const double log_x = r < 1e8 ? -std::log1p(r * r) : -2.0 * std::log(r);
  const double log_rest = 2.0 * std::log(r) + log_x;
  const double beta = boost::math::tgamma_delta_ratio(a, 0.5) * boost::math::constants::root_pi<double>();
  return a * log_x + 0.5 * log_rest - std::log(a * beta) +
         std::log(incompleteBetaFraction(a, 0.5, std::exp(log_x)));
}

}  // namespace

double log10TwoSidedP(double t, double degrees_of_freedom) {
  CAPSTAN_ASSERT(std::isfinite(t) && degrees_of_freedom > 0.0);
  constexpr double kFar = 1e50;      // beyond it Boost's t² would come near overflow
  constexpr double kSmall = 1e-280;  // below it P is near what a double can hold
  if (std::abs(t) < kFar) {
    const boost::math::students_t distribution(degrees_of_freedom);
    const double p = 2.0 * boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
    if (p > kSmall) return std::log10(p);
  }
  return logTail(t, degrees_of_freedom) / boost::math::constants::ln_ten<double>();
}

}  // namespace capstan::stats
