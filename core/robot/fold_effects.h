#pragma once

#include "core/robot/description.h"

namespace capstan::robot {

/// The same robot with those effects written into its numbers that these can hold exactly: pulley_radius,
/// cable_coupling, homing_offset, viscous_friction, gravity_tilt, cable_compliance of a cable drive (two
/// springs in series), and payload where it leaves the last link's inertia without products. The others stay
/// in `effects`.
Description foldEffects(Description description);

}  // namespace capstan::robot
