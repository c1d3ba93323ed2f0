#pragma once

namespace capstan::robot {

inline constexpr int kMostStages = 24;

/// Coefficients of a Runge–Kutta–Chebyshev method of second order (Sommeijer, Shampine, Verwer, RKC, J.
/// Comput. Appl. Math. 88, 1997), `count` stages:
///     Y_1 = Y_0 + first h F_0,
///     Y_j = (1 − μ_j − ν_j) Y_0 + μ_j Y_{j−1} + ν_j Y_{j−2} + h mu_slope_j F_{j−1} + h gamma_j F_0,
/// F_j at t + instant_j h. Stable along the negative real axis to 0.65 (count² − 1), so that the damping of
/// cables and friction, up to some thousands a second, costs few stages.
struct ChainStages {
  int count = 2;
  double first = 0.0;
  double mu[kMostStages + 1] = {}, nu[kMostStages + 1] = {};
  double mu_slope[kMostStages + 1] = {}, gamma[kMostStages + 1] = {};
  double instant[kMostStages + 1] = {};
};

/// Stages for steps of h seconds of a chain whose eigenvalues are within `rate` [1/s], 3 at least and
/// kMostStages at most.
ChainStages chainStages(double rate, double h);

}  // namespace capstan::robot
