#include "core/robot/effects.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"

namespace capstan::robot {
namespace {

/// Which drives an effect may be in, and whether it is one of the whole arm.
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
      factsOf("pulley_radius", kCableDrive,
              {{"share", "", -0.5, 0.5, "by which r_l is larger than the nominal one"}}),
      factsOf("cable_coupling", kCableDrive,
              {{"added", "rad/rad or m/rad", -10.0, 10.0, "added to A(joint, other)"},
               {"other", "", 1.0, 7.0, "joint whose motion is carried over, from 1"}}),
      factsOf("homing_offset", kCableDrive,
              {{"offset", "rad or m", -3.2, 3.2, "added to q_hs, the position at the hard stop"}}),
      factsOf(
          "zero_drift", kCableDrive,
          {{"drift", "rad or m", -3.2, 3.2, "that is added to q_hs in the long run"},
           {"time_constant", "s", 1e-3, 1e6, "with which it gets there, from the begin of the recording"}}),
      factsOf("encoder_slip", kCableDrive,
              {{"slip", "rad", -1e3, 1e3, "by which the motor's reading falls short from then on"},
               {"time", "s", 0.0, 1e6, "when it slips, since the begin of the recording"}}),
      factsOf("capstan_eccentricity", kCableDrive,
              {{"sine", "m", -0.1, 0.1, "travel of the cable beyond a round capstan's, by cos(phi) - 1"},
               {"cosine", "m", -0.1, 0.1, "travel of the cable beyond a round capstan's, by sin(phi)"}}),
  };
}

std::vector<EffectFacts> cableEffects() {
  return {
      factsOf("cable_compliance", kAnyDrive,
              {{"compliance", "m/N", 0.0, 1e3, "stretch by force, in series with the nominal cable"}}),
      factsOf("cable_stiffening", kCableDrive,
              {{"cubic", "1/m^2", -1e7, 1e13, "c in the added force 2 k_e a c delta^3"}}),
      factsOf("position_stiffness", kCableDrive,
              {{"share", "", -0.8, 0.8, "stiffness is divided by 1 + share x, x = -1 … 1 over the range"}}),
      factsOf("backlash", kCableDrive, {{"half_width", "m", 0.0, 0.1, "half of the play"}}),
      factsOf("slack", kCableDrive,
              {{"pretension", "m", -0.1, 1e3,
                "stretch at which one of the two cables sags; negative: both are too long by it"}}),
      factsOf("cable_hysteresis", kCableDrive,
              {{"force", "N", 0.0, 1e5, "that the loop adds at most"},
               {"yield", "m", 1e-8, 1.0, "stretch within which it builds up"}}),
      factsOf("cable_creep", kCableDrive,
              {{"share", "", 0.0, 20.0, "of the elastic stretch that is added in the long run"},
               {"time_constant", "s", 1e-3, 1e4, "of the creep"}}),
  };
}

std::vector<EffectFacts> frictionEffects() {
  return {
      factsOf("stribeck_friction", kAnyDrive,
              {{"excess", "", -1.0, 20.0, "friction beyond Coulomb's at rest, share of it"},
               {"speed", "rad/s or m/s", 1e-6, 1e2, "Stribeck's, at which 1/e of the excess is left"}}),
      factsOf("asymmetric_friction", kAnyDrive,
              {{"share", "", -1.0, 1.0, "Coulomb friction is 1 + share forwards, 1 - share backwards"}}),
      factsOf("asymmetric_viscosity", kRigidDrive,
              {{"share", "", -1.0, 1.0, "viscous friction is 1 + share forwards, 1 - share backwards"}}),
      factsOf("viscous_friction", kAnyDrive,
              {{"added", "N*m*s/rad or N*s/m", -1e4, 1e4, "to the nominal viscous friction"}}),
      factsOf("load_friction", kAnyDrive,
              {{"share", "", 0.0, 2.0, "of the magnitude of the driving torque that turns into friction"}}),
      factsOf("position_friction", kAnyDrive,
              {{"sine", "", -2.0, 2.0, "share of Coulomb friction, by sin(2 pi q/period)"},
               {"cosine", "", -2.0, 2.0, "share of Coulomb friction, by cos(2 pi q/period)"},
               {"period", "rad or m", 1e-4, 1e2, "of the joint after which it repeats"}}),
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
              {{"added", "kg*m^2 or kg", -1e3, 1e3, "to the joint's diagonal of the mass matrix"}}),
      factsOf("actuator_gain", kRigidDrive,
              {{"share", "", -0.9, 3.0, "by which the motor gives more than it is commanded"}}),
      factsOf("torque_offset", kRigidDrive,
              {{"offset", "N*m or N", -1e5, 1e5, "that pushes towards positive q all the time"}}),
  };
}

std::vector<EffectFacts> sensorEffects() {
  return {
      factsOf("camera_latency", kWholeArm,
              {{"delay", "s", -1.0, 1.0, "by which the cameras' stamps come late"}}),
      factsOf("camera_rotation", kWholeArm,
              {{"x", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"},
               {"y", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"},
               {"z", "rad", -0.8, 0.8, "rotation vector of what the cameras see, about frame 0's origin"}}),
      factsOf("camera_offset", kWholeArm,
              {{"x", "m", -1.0, 1.0, "added to what the cameras see, frame 0"},
               {"y", "m", -1.0, 1.0, "added to what the cameras see, frame 0"},
               {"z", "m", -1.0, 1.0, "added to what the cameras see, frame 0"}}),
      factsOf("camera_scale", kWholeArm,
              {{"share", "", -0.5, 0.5, "by which the cameras see lengths larger"}}),
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
    for (const EffectParameter& p : facts->parameters)
      all += fmt::format("{}{}", all.empty() ? "" : ", ", p.name);
  throw base::InputError({{},
                          0,
                          "effects",
                          effect,
                          fmt::format("has no number `{}`", parameter),
                          facts == nullptr ? "Check the effect's name" : "Give all of its numbers: " + all});
}

}  // namespace capstan::robot
