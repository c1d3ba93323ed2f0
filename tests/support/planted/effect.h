#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

namespace capstan::test {

/// Effects that can be planted in a robot. kExternalVibration to kEncoderDrift are not among the hypotheses
/// of a diagnosis. Seeds depend on the order: a new effect comes last.
enum class Effect {
  kPulleyRadius,
  kCableCoupling,
  kHomingOffset,
  kEncoderSlip,
  kCapstanEccentricity,
  kCableCompliance,
  kCableStiffening,
  kPositionStiffness,
  kBacklash,
  kSlack,
  kCableHysteresis,
  kCableCreep,
  kStribeckFriction,
  kAsymmetricFriction,
  kViscousFriction,
  kLoadFriction,
  kPositionFriction,
  kGravityTilt,
  kPayload,
  kInertia,
  kActuatorGain,
  kCameraLatency,
  kCameraRotation,
  kCameraOffset,
  kCameraScale,
  kSensorSign,
  kExternalVibration,
  kNonlinearSpring,
  kJointDetent,
  kEncoderDrift,
  kZeroDrift,
};

/// Part of the robot that an effect belongs to, which decides in which joints and drives it can be planted.
enum class Place { kTransmission, kCable, kFriction, kBody, kCamera, kSensor, kOutside };

/// Properties of an effect.
struct EffectFacts {
  Effect effect;
  std::string_view name;       ///< name as in reports: backlash
  std::string_view magnitude;  ///< meaning of Planted::magnitude, with its unit
  Place place;
  bool cable;    ///< can be planted in a cable drive
  bool rigid;    ///< can be planted in a rigid drive
  bool whole;    ///< belongs to the whole arm or a camera: joint 0
  bool covered;  ///< false: it is not among the hypotheses of a diagnosis
};

/// All effects, in the order of the enumeration.
const std::vector<EffectFacts>& allEffects();
const EffectFacts& factsOf(Effect effect);
/// Facts of the effect of this name; null: none.
const EffectFacts* effectNamed(std::string_view name);

/// One effect in a plant; at magnitude 0 it has no influence.
struct Planted {
  Effect effect = Effect::kPulleyRadius;
  int joint = 0;           ///< counts from 0; not used by effects of the whole arm
  double magnitude = 0.0;  ///< EffectFacts::magnitude
  double signature = 1.0;  ///< a second number with a unit of its own: speed, time constant, frequency, width
  double phase = 0.0;      ///< [rad], or the time of a slip as a share of the recording
  int other = 0;           ///< other joint, whose motion a coupling transmits
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< direction in frame 0, of unit length
};

}  // namespace capstan::test
