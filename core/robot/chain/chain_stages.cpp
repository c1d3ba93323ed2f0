#include "core/robot/chain/chain_stages.h"

#include <algorithm>
#include <cmath>

namespace capstan::robot {
namespace {

/// Chebyshev polynomial of the first kind and its first two derivatives at x, of degrees 0 … n.
struct Chebyshev {
  double t[kMostStages + 1], dt[kMostStages + 1], ddt[kMostStages + 1];

  Chebyshev(int n, double x) : t{1.0, x}, dt{0.0, 1.0}, ddt{} {
    for (int j = 2; j <= n; ++j) {
      t[j] = 2.0 * x * t[j - 1] - t[j - 2];
      dt[j] = 2.0 * t[j - 1] + 2.0 * x * dt[j - 1] - dt[j - 2];
      ddt[j] = 4.0 * dt[j - 1] + 2.0 * x * ddt[j - 1] - ddt[j - 2];
    }
  }
};

}  // namespace

ChainStages chainStages(double rate, double h) {
  constexpr double kDamping = 2.0 / 13.0;
  const double reach = std::isfinite(rate) ? std::sqrt(1.0 + 1.65 * rate * h) : kMostStages;
  const int s = std::clamp(1 + static_cast<int>(reach), 3, kMostStages);
  const double w0 = 1.0 + kDamping / (s * s);
  const Chebyshev c(s, w0);
  const double w1 = c.dt[s] / c.ddt[s];
  double b[kMostStages + 1], a[kMostStages + 1];
  for (int j = 2; j <= s; ++j) b[j] = c.ddt[j] / (c.dt[j] * c.dt[j]);
  b[0] = b[1] = b[2];
  for (int j = 0; j <= s; ++j) a[j] = 1.0 - b[j] * c.t[j];
  ChainStages stages;
  stages.count = s;
  stages.first = b[1] * w1;
  for (int j = 2; j <= s; ++j) {
    stages.mu[j] = 2.0 * b[j] * w0 / b[j - 1];
    stages.nu[j] = -b[j] / b[j - 2];
    stages.mu_slope[j] = 2.0 * b[j] * w1 / b[j - 1];
    stages.gamma[j] = -a[j - 1] * stages.mu_slope[j];
    stages.instant[j] = w1 * c.ddt[j] / c.dt[j];
  }
  stages.instant[1] = stages.instant[2] / (4.0 * w0);
  return stages;
}

}  // namespace capstan::robot
