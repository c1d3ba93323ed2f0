#include "core/robot/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace capstan::robot {
namespace {

/// Drives that can have an effect, and whether it belongs to the whole arm.
struct Scope {
  bool whole, cable, rigid;
};
constexpr Scope kCableDrive{false, true, false};
constexpr Scope kAnyDrive{false, true, true};
constexpr Scope kRigidDrive{false, false, true};
constexpr Scope kWholeArm{true, true, true};

EffectFacts factsOf(std::string_view name, Scope scope, std::vector<EffectParameter> parameters) {
  return {name, scope.whole, scope.cable, scope.rigid, std::move(parameters)};
}

std::vector<EffectFacts> transmissionEffects() {
  return {
      factsOf("pulley_radius", kCableDrive, {{"share", "", -0.5, 0.5, "relative increase of r_l"}}),
      factsOf("cable_coupling", kCableDrive,
              {{"added", "rad/rad or m/rad", -10.0, 10.0,
                "added to the element (joint, other) of the coupling matrix A"},
               {"other", "", 1.0, 7.0, "joint whose motion moves the cable, from 1"}}),
      factsOf(
          "homing_offset", kCableDrive,
          {{"offset", "rad or m", -3.2, 3.2, "added to q_hs, the position at the hard stop"},
           {"at_motor", "", 0.0, 1.0,
            "0: the joint stopped elsewhere; 1: the zero of its motor is off, which also moves joints whose "
            "cables are coupled to this one",
            0.0}}),
      factsOf(
          "zero_drift", kCableDrive,
          {{"drift", "rad or m", -3.2, 3.2, "final drift of the cable's zero, as a motion of the joint"},
           {"time_constant", "s", 1e-3, 1e6, "time constant of the drift, which begins with the recording"}}),
      factsOf("encoder_slip", kCableDrive,
              {{"slip", "rad", -1e3, 1e3, "deficit of the motor's reading after the slip"},
               {"time", "s", 0.0, 1e6, "time of the slip since the begin of the recording"}}),
      factsOf("capstan_eccentricity", kCableDrive,
              {{"sine", "m", -0.1, 0.1,
                "e_s in the added cable travel e_c sin(phi) + e_s (cos(phi) - 1); phi: angle of the capstan"},
               {"cosine", "m", -0.1, 0.1, "e_c in the same equation"}}),
  };
}

std::vector<EffectFacts> cableEffects() {
  return {
      factsOf("cable_compliance", kAnyDrive,
              {{"compliance", "m/N", 0.0, 1e3, "stretch per force, in series with the nominal cable"}}),
      factsOf("cable_stiffening", kCableDrive,
              {{"cubic", "1/m^2", -1e7, 1e13, "c in the added force 2 k_e a c delta^3"}}),
      factsOf("position_stiffness", kCableDrive,
              {{"share", "", -2.0, 2.0,
                "growth of the free length, or loss of stiffness, from the middle of the joint's range to "
                "its upper "
                "limit"},
               {"of_length", "", 0.0, 1.0,
                "1: the free length changes linearly with the position; 0: the stiffness does", 1.0}}),
      factsOf("backlash", kCableDrive,
              {{"half_width", "m", 0.0, 0.1, "half of the total play"},
               {"damping", "", 0.0, 2.0,
                "action of the cable's damper: 0 pressing only, 1 while the play is closed, 2 always", 0.0}}),
      factsOf("slack", kCableDrive,
              {{"pretension", "m", -0.1, 1e3,
                "stretch at which one of the two cables sags; negative when both are too long"}}),
      factsOf("cable_hysteresis", kCableDrive,
              {{"force", "N", 0.0, 1e5, "largest additional force of the hysteresis loop"},
               {"yield", "m", 1e-8, 1.0, "stretch over which the force builds up"}}),
      factsOf("cable_creep", kCableDrive,
              {{"share", "", 0.0, 20.0, "final creep as a share of the elastic stretch"},
               {"time_constant", "s", 1e-3, 1e4, "time constant of the creep"}}),
  };
}

std::vector<EffectFacts> frictionEffects() {
  return {
      factsOf("stribeck_friction", kAnyDrive,
              {{"excess", "", -1.0, 20.0, "additional friction at rest, share of Coulomb's"},
               {"speed", "rad/s or m/s", 1e-6, 1e2, "Stribeck speed, where 1/e of the excess remains"}}),
      factsOf("asymmetric_friction", kAnyDrive,
              {{"share", "", -1.0, 1.0, "Coulomb friction times 1 + share forwards, 1 - share backwards"}}),
      factsOf("asymmetric_viscosity", kRigidDrive,
              {{"share", "", -1.0, 1.0, "viscous friction times 1 + share forwards, 1 - share backwards"}}),
      factsOf("viscous_friction", kAnyDrive,
              {{"added", "N*m*s/rad or N*s/m", -1e4, 1e4, "added to the nominal viscous friction"}}),
      factsOf("load_friction", kAnyDrive,
              {{"share", "", 0.0, 2.0, "friction as a share of the magnitude of the driving torque"}}),
      factsOf("position_friction", kAnyDrive,
              {{"sine", "", -2.0, 2.0, "share of Coulomb friction, times sin(2 pi q/period)"},
               {"cosine", "", -2.0, 2.0, "share of Coulomb friction, times cos(2 pi q/period)"},
               {"period", "rad or m", 1e-4, 1e2, "period of the friction in joint position"}}),
  };
}

std::vector<EffectFacts> bodyEffects() {
  return {
      factsOf("gravity_tilt", kWholeArm,
              {{"x", "rad", -3.2, 3.2, "rotation vector that turns gravity in frame 0"},
               {"y", "rad", -3.2, 3.2, "rotation vector that turns gravity in frame 0"},
               {"z", "rad", -3.2, 3.2, "rotation vector that turns gravity in frame 0"}}),
      factsOf("payload", kWholeArm, {{"mass", "kg", -10.0, 100.0, "point mass at the marker"}}),
      factsOf("inertia", kAnyDrive,
              {{"added", "kg*m^2 or kg", -1e3, 1e3, "added to the joint's diagonal of the mass matrix"}}),
      factsOf("actuator_gain", kRigidDrive,
              {{"share", "", -0.9, 3.0, "relative excess of the motor torque over its command"}}),
      factsOf("torque_offset", kRigidDrive,
              {{"offset", "N*m or N", -1e5, 1e5, "constant torque or force towards positive q"}}),
  };
}

std::vector<EffectFacts> sensorEffects() {
  return {
      factsOf("camera_latency", kWholeArm, {{"delay", "s", -1.0, 1.0, "delay of the cameras' time stamps"}}),
      factsOf("camera_rotation", kWholeArm,
              {{"x", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"},
               {"y", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"},
               {"z", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"}}),
      factsOf("camera_offset", kWholeArm,
              {{"x", "m", -1.0, 1.0, "added to what the cameras see, frame 0"},
               {"y", "m", -1.0, 1.0, "added to what the cameras see, frame 0"},
               {"z", "m", -1.0, 1.0, "added to what the cameras see, frame 0"}}),
      factsOf("camera_scale", kWholeArm,
              {{"share", "", -0.5, 0.5, "relative excess of lengths in the camera measurements"}}),
      factsOf(
          "sensor_sign", kAnyDrive,
          {{"present", "", -1.0, 1.0,
            "0: the load sensor measures the sign; 1 or -1: magnitude only, the first load is positive or "
            "negative"}}),
  };
}

}  // namespace

const std::vector<EffectFacts>& effectFacts() {
  static const std::vector<EffectFacts> all = [] {
    std::vector<EffectFacts> facts;
    for (const auto& part :
         {transmissionEffects(), cableEffects(), frictionEffects(), bodyEffects(), sensorEffects()})
      facts.insert(facts.end(), part.begin(), part.end());
    return facts;
  }();
  return all;
}

const EffectFacts* effectNamed(std::string_view name) {
  const auto& all = effectFacts();
  const auto found = std::ranges::find(all, name, &EffectFacts::name);
  return found == all.end() ? nullptr : &*found;
}

double Effect::operator[](std::string_view parameter) const {
  const auto found = std::ranges::find(values, parameter, &EffectValue::parameter);
  if (found != values.end()) return found->value;
  const EffectFacts* facts = effectNamed(effect);
  std::string all;
  if (facts != nullptr)
    for (const EffectParameter& p : facts->parameters) {
      if (p.name == parameter && p.omitted) return *p.omitted;
      all += fmt::format("{}{}", all.empty() ? "" : ", ", p.name);
    }
  throw base::InputError({{},
                          0,
                          "effects",
                          effect,
                          fmt::format("has no number `{}`", parameter),
                          facts == nullptr ? "Check the effect's name" : "Give all of its numbers: " + all});
}

}  // namespace capstan::robot
