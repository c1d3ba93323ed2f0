#pragma once

#include <cmath>

#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// Friction force: Coulomb and viscous friction with a Stribeck excess (Stribeck in truth.h).
inline double frictionForce(const robot::Friction& friction, const Stribeck& stribeck, double speed) {
  double coulomb = friction.coulomb;
  if (stribeck.excess > 0.0) {
    const double fade = speed / stribeck.speed;
    coulomb *= 1.0 + stribeck.excess * std::exp(-fade * fade);
  }
  return coulomb * std::tanh(speed / friction.smoothing) + friction.viscous * speed;
}

/// dz/dt of Bouc–Wen hysteresis (Hysteresis in truth.h).
inline double hysteresisRate(const Hysteresis& law, double z, double stretch_rate) {
  if (law.stiffness <= 0.0) return 0.0;
  const double load = std::abs(z) / law.yield;
  const double slip = law.exponent == 1.0 ? load : std::pow(load, law.exponent);
  const double sign = z * stretch_rate >= 0.0 ? 1.0 : -1.0;
  return stretch_rate * (1.0 - slip * (law.shape * sign + 1.0 - law.shape));
}

}  // namespace capstan::simulation
