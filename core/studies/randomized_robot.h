#pragma once

#include <cstdint>

#include "core/simulation/truth.h"

namespace capstan::studies {

/// Spread of randomized robots around a truth: standard deviations, of logarithms where no unit is given.
/// Draws are cut at two standard deviations.
struct RandomizationSpread {
  double link_radius = 0.02;       ///< σ of each r_l
  double stiffness = 0.3;          ///< σ of each k_e
  double damping = 0.3;            ///< σ of each b_e
  double hysteresis = 0.3;         ///< σ of the stiffness of each hysteretic branch
  double stribeck = 0.3;           ///< σ of each breakaway excess
  double camera_rotation = 0.007;  ///< σ of the mounting error about each axis, with mean zero [rad]
  double camera_delay = 0.003;     ///< σ of the delay of the camera's stamps, with mean zero [s]
};

/// Draws a robot and its cameras around `centre`; same seed, same robot. An effective radius that `centre`
/// does not give is drawn around `nominal_radius` [m/rad, m/rad, m/m].
simulation::Truth drawRandomizedRobot(const simulation::Truth& centre, const Eigen::Vector3d& nominal_radius,
                                      const RandomizationSpread& spread, std::uint64_t seed);

}  // namespace capstan::studies
