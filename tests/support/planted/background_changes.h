#pragma once

#include <vector>

#include "tests/support/planted/plant_parameters.h"

namespace capstan::test {

/// One number by which a robot without a fault may differ: a drifted one of drifted(), or a part of
/// backgroundTexture(), off by kBackgroundStep of its standard deviation.
struct BackgroundChange {
  robot::Description robot;      ///< drifted, that number off; as it is where it is one of texture
  std::vector<Planted> texture;  ///< that part of texture; empty: none
  double low = 0.0, high = 0.0;  ///< how far from here it may be, in standard deviations
};
inline constexpr double kBackgroundStep = 0.02;

/// Of each joint: friction of joint and motor, mass with its inertia, centre of mass, stiffness and damping
/// of a cable; then the texture.
std::vector<BackgroundChange> backgroundChanges(const robot::Description& nominal,
                                                const robot::Description& worn, bool rigid);

}  // namespace capstan::test
