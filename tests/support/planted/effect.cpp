#include "tests/support/planted/effect.h"

#include <algorithm>

namespace capstan::test {
namespace {

std::vector<EffectFacts> makeFacts() {
  using enum Effect;
  using enum Place;
  // cable, rigid, whole, covered
  return {
      {kPulleyRadius, "pulley_radius", "share of the link radius", kTransmission, true, false, false, true},
      {kCableCoupling, "cable_coupling", "added to A(joint, other)", kTransmission, true, false, false, true},
      {kHomingOffset, "homing_offset", "rad or m", kTransmission, true, false, false, true},
      {kEncoderSlip, "encoder_slip", "rad of the motor", kTransmission, true, false, false, true},
      {kCapstanEccentricity, "capstan_eccentricity", "m of cable", kTransmission, true, false, false, true},
      {kCableCompliance, "cable_compliance", "m/N of cable", kCable, false, true, false, true},
      {kCableStiffening, "cable_stiffening", "1/m^2", kCable, true, false, false, true},
      {kPositionStiffness, "position_stiffness", "share at the ends of the range", kCable, true, false, false,
       true},
      {kBacklash, "backlash", "half-width, m of cable", kCable, true, false, false, true},
      {kSlack, "slack", "share of the pretension that is lost", kCable, true, false, false, true},
      {kCableHysteresis, "cable_hysteresis", "N", kCable, true, false, false, true},
      {kCableCreep, "cable_creep", "share of the elastic stretch", kCable, true, false, false, true},
      {kStribeckFriction, "stribeck_friction", "breakaway excess, share of Coulomb", kFriction, true, true,
       false, true},
      {kAsymmetricFriction, "asymmetric_friction", "share of Coulomb", kFriction, true, true, false, true},
      {kViscousFriction, "viscous_friction", "N*m*s/rad or N*s/m", kFriction, true, true, false, true},
      {kLoadFriction, "load_friction", "share of the driving torque", kFriction, true, true, false, true},
      {kPositionFriction, "position_friction", "share of Coulomb", kFriction, true, true, false, true},
      {kGravityTilt, "gravity_tilt", "rad", kBody, true, true, true, true},
      {kPayload, "payload", "kg", kBody, true, true, true, true},
      {kInertia, "inertia", "kg*m^2 or kg", kBody, true, true, false, true},
      {kActuatorGain, "actuator_gain", "share of the command", kSensor, false, true, false, true},
      {kCameraLatency, "camera_latency", "s", kCamera, true, true, true, true},
      {kCameraRotation, "camera_rotation", "rad", kCamera, true, true, true, true},
      {kCameraOffset, "camera_offset", "m", kCamera, true, true, true, true},
      {kCameraScale, "camera_scale", "share", kCamera, true, true, true, true},
      {kSensorSign, "sensor_sign", "1: the load sensor tells no sign", kSensor, true, true, false, true},
      {kExternalVibration, "external_vibration", "N*m or N", kOutside, true, true, false, false},
      {kNonlinearSpring, "nonlinear_spring", "N*m or N at the ends of the range", kOutside, true, true, false,
       false},
      {kJointDetent, "joint_detent", "N*m or N", kOutside, true, true, false, false},
      {kEncoderDrift, "encoder_drift", "rad/s or m/s", kOutside, true, true, false, false},
      {kZeroDrift, "zero_drift", "rad or m", kTransmission, true, false, false, true},
  };
}

}  // namespace

const std::vector<EffectFacts>& allEffects() {
  static const std::vector<EffectFacts> facts = makeFacts();
  return facts;
}

const EffectFacts& factsOf(Effect effect) { return allEffects()[static_cast<std::size_t>(effect)]; }

const EffectFacts* effectNamed(std::string_view name) {
  const auto& all = allEffects();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const auto& facts) { return facts.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace capstan::test
