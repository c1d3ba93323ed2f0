#pragma once

#include <vector>

#include "tests/support/planted/plant_parameters.h"

namespace capstan::test {

/// Change of one number in which robots without a fault differ: a number that worn() draws, or one effect of
/// backgroundTexture(). It is changed by kBackgroundStep standard deviations.
struct BackgroundChange {
  robot::Description robot;      ///< the worn robot with that number changed; unchanged for an effect
  std::vector<Planted> texture;  ///< that effect; empty: none
  double low = 0.0, high = 0.0;  ///< range of the number about its value, in standard deviations
};
inline constexpr double kBackgroundStep = 0.02;

/// All such changes, each within the range of `ageing`. For each joint these are friction of joint and motor,
/// mass with its inertia, centre of mass, stiffness and damping of a cable; then follow the effects of the
/// texture.
std::vector<BackgroundChange> backgroundChanges(const robot::Description& nominal,
                                                const robot::Description& worn, bool rigid,
                                                const Ageing& ageing);

}  // namespace capstan::test
