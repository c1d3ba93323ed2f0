#pragma once

#include <cmath>

/// Laws of slow motion, in which inertia plays no part: what moves is where its forces and its friction hold
/// each other.
namespace capstan::simulation {

/// A spring's force behind a play of half-width `play` [m], by its stretch [m] and stiffness [N/m]:
///     k sgn(x) max(|x| − play, 0).
inline double forceBeyondPlay(double stretch, double play, double stiffness) {
  const double beyond = std::abs(stretch) - play;
  return beyond > 0.0 ? std::copysign(stiffness * beyond, stretch) : 0.0;
}

/// Coulomb friction with a Stribeck excess (Armstrong-Hélouvry, Dupont and Canudas de Wit, Automatica 30,
/// 1994) at a speed: coulomb (1 + excess e^{−(v / v_s)²}).
inline double breakaway(double coulomb, double excess, double stribeck_speed, double speed) {
  const double fade = speed / stribeck_speed;
  return coulomb * (1.0 + excess * std::exp(-fade * fade));
}

/// How far something moves in a time h from rest at 0 under a force `net` there, against a spring, dry
/// friction `dry` ≥ 0 and viscous friction: x of
///     net − stiffness x − viscous x / h ∈ dry sgn(x),
/// 0 where |net| ≤ dry: it sticks. In the units of the force over those of the stiffness.
inline double moved(double net, double dry, double stiffness, double viscous, double h) {
  if (std::abs(net) <= dry) return 0.0;
  return (net - std::copysign(dry, net)) / (stiffness + viscous / h);
}

}  // namespace capstan::simulation
