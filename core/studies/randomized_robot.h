#pragma once

#include <cstdint>

#include "core/simulation/truth.h"

namespace capstan::studies {

/// How randomized robots differ from the truth that they are drawn around: standard deviations, of logarithms
/// where no unit is given. Draws beyond two of them are cut off.
struct RandomizationSpread {
  double link_radius = 0.02;       ///< of each r_l
  double stiffness = 0.3;          ///< of each k_e
  double damping = 0.3;            ///< of each b_e
  double hysteresis = 0.3;         ///< of each hysteretic branch's stiffness
  double stribeck = 0.3;           ///< of each breakaway excess
  double camera_rotation = 0.007;  ///< mounting error about each axis, about none [rad]
  double camera_delay = 0.003;     ///< of the camera's stamps, about none [s]
};

/// A robot and its cameras drawn around `centre`; same seed, same robot. An effective radius that `centre`
/// leaves open is drawn around `nominal_radius` [m/rad, m/rad, m/m].
simulation::Truth drawRandomizedRobot(const simulation::Truth& centre, const Eigen::Vector3d& nominal_radius,
                                      const RandomizationSpread& spread, std::uint64_t seed);

}  // namespace capstan::studies
