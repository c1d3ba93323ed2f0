#pragma once

#include <string>
#include <vector>

#include "tests/support/planted_study/case_outcome.h"

namespace capstan::study {

/// A number of what was planted beside the one that was found.
struct NumberCheck {
  std::string name;
  double planted = 0.0, found = 0.0, sigma = 0.0;  ///< SI; found NaN: the cause does not tell it
  /// |found − planted| ≤ 1.96 sigma; equal where sigma is 0. A wrong sign is outside like any other value.
  bool inside() const;
};

/// The numbers of item `which` of `truth` beside those of a cause of the same effect. The planted plant
/// counts its numbers in its own way; what follows is, number by number, what a cause would have to say
/// (robot::EffectFacts), m being test::Planted::magnitude and s its signature:
///   one to one      pulley_radius, homing_offset, cable_compliance, cable_stiffening, position_stiffness,
///                   backlash, viscous_friction, load_friction, payload, inertia, actuator_gain,
///                   camera_latency, camera_scale: m
///   cable_coupling  added: m, and `other` must be the planted one, or the number is not told
///   encoder_slip    slip: m; time: begins at phase × duration and lasts s, anything between is right
///   asymmetric_friction  share: m and that of the texture
///   cable_hysteresis, cable_creep, zero_drift, stribeck_friction  m and s (force, yield; share, time
///                   constant; drift, time constant; excess, speed); the trace of Stribeck in the texture,
///                   slower than it, is not added
///   slack           pretension: s (1 − m)
///   capstan_eccentricity  m e^{i phase} and that of the texture; found as √(sine² + cosine²)
///   position_friction     amplitude m as √(sine² + cosine²); period: s
///   gravity_tilt, camera_rotation, camera_offset  m along the planted axis: found is the vector's component
///   sensor_sign     nothing: it is there or not
/// Of √(sine² + cosine²) and of components the sigma is that of independent errors.
std::vector<NumberCheck> checkNumbers(const HiddenTruth& truth, std::size_t which, const NamedCause& cause);

}  // namespace capstan::study
