#pragma once

#include <cmath>

/// Laws of quasi-static motion: inertia is neglected, and at each instant forces and friction are in
/// equilibrium.
namespace capstan::simulation {

/// Force [N] of a spring in series with backlash of half-width `play` [m], from stretch x [m] and stiffness k
/// [N/m]: k sgn(x) max(|x| − play, 0).
inline double forceBeyondPlay(double stretch, double play, double stiffness) {
  const double beyond = std::abs(stretch) - play;
  return beyond > 0.0 ? std::copysign(stiffness * beyond, stretch) : 0.0;
}

/// Coulomb friction with a Stribeck excess (Armstrong-Hélouvry, Dupont and Canudas de Wit, Automatica 30,
/// 1994) at speed v: coulomb (1 + excess e^{−(v / v_s)²}).
inline double breakaway(double coulomb, double excess, double stribeck_speed, double speed) {
  const double fade = speed / stribeck_speed;
  return coulomb * (1.0 + excess * std::exp(-fade * fade));
}

/// Displacement x in time `h` from rest at 0, under the force `net` at 0, a spring, dry friction `dry` ≥ 0
/// and viscous friction. It solves
///     net − stiffness x − viscous x / h ∈ dry sgn(x);
/// x = 0 (stiction) where |net| ≤ dry. Its unit is that of force / stiffness.
inline double moved(double net, double dry, double stiffness, double viscous, double h) {
  if (std::abs(net) <= dry) return 0.0;
  return (net - std::copysign(dry, net)) / (stiffness + viscous / h);
}

}  // namespace capstan::simulation
