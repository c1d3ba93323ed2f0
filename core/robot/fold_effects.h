#pragma once

#include "core/robot/description.h"

namespace capstan::robot {

/// Returns the same robot with all effects written into its nominal numbers that these can represent exactly:
/// pulley_radius, cable_coupling, homing_offset, viscous_friction, gravity_tilt, cable_compliance of a cable
/// drive (two springs in series), and payload when the last link keeps an inertia without products. The other
/// effects stay in `effects`.
Description foldEffects(Description description);

}  // namespace capstan::robot
