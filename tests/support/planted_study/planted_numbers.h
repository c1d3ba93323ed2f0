#pragma once

#include <string>
#include <vector>

#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// Comparison of one planted number with the estimated one.
struct NumberCheck {
  std::string name;
  double planted = 0.0, found = 0.0, sigma = 0.0;  ///< SI; found NaN: the cause has no such number
  /// True if |found − planted| ≤ 1.96 sigma. A wrong sign counts like any other error.
  bool inside() const;
};

/// Compares the numbers of item `which` of `truth` with those of a cause of the same effect. The plant has
/// its own parameters. The list gives the correct numbers of a cause (robot::EffectFacts), where m is
/// test::Planted::magnitude and s is test::Planted::signature:
///   one to one      pulley_radius, homing_offset, cable_compliance, cable_stiffening, position_stiffness,
///                   backlash, viscous_friction, load_friction, payload, inertia, actuator_gain,
///                   camera_latency, camera_scale: m
///   cable_coupling  added: m; `other` must be the planted joint, else found is NaN
///   encoder_slip    slip: m; time: from phase × duration to s later, any time between is right
///   asymmetric_friction  share: m and that of the texture
///   cable_hysteresis, cable_creep, zero_drift, stribeck_friction  m and s (force, yield; share, time
///                   constant; drift, time constant; excess, speed); the Stribeck friction of the
///                   texture, with a lower speed, is not added
///   slack           pretension: s (1 − m)
///   capstan_eccentricity  m e^{i phase} and that of the texture; found as √(sine² + cosine²)
///   position_friction     amplitude m as √(sine² + cosine²); period: s
///   gravity_tilt, camera_rotation, camera_offset  m along the planted axis: found is the vector's component
///   sensor_sign     no numbers
/// The sigmas of √(sine² + cosine²) and of components assume independent errors.
std::vector<NumberCheck> checkNumbers(const HiddenTruth& truth, std::size_t which, const NamedCause& cause);

}  // namespace capstan::study
