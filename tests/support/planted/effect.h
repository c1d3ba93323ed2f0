#pragma once

#include <Eigen/Core>
#include <optional>
#include <string_view>
#include <vector>

namespace capstan::test {

/// What can be wrong with the planted robot. kExternalVibration to kEncoderDrift have no name among the
/// effects that a diagnosis would look for. The order decides on seeds: a new one comes last.
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

/// Where an effect sits: decides on which joints and drives it can be planted.
enum class Place { kTransmission, kCable, kFriction, kBody, kCamera, kSensor, kOutside };

struct EffectFacts {
  Effect effect;
  std::string_view name;       ///< as in verdicts: backlash
  std::string_view magnitude;  ///< what Planted::magnitude is, with its unit
  Place place;
  bool cable;    ///< can be planted in a cable drive
  bool rigid;    ///< can be planted in a rigid drive
  bool whole;    ///< of the whole arm or a camera: joint 0
  bool covered;  ///< false: no diagnosis is expected to have a name for it
};

/// All effects, in the order of the enumeration.
const std::vector<EffectFacts>& allEffects();
const EffectFacts& factsOf(Effect effect);
/// Null: no effect of this name.
const EffectFacts* effectNamed(std::string_view name);

/// One effect as it sits in a plant; nothing of it is left at magnitude 0.
struct Planted {
  Effect effect = Effect::kPulleyRadius;
  int joint = 0;           ///< counts from 0; not used by effects of the whole arm
  double magnitude = 0.0;  ///< EffectFacts::magnitude
  double signature = 1.0;  ///< a second number with a unit of its own: speed, time constant, frequency, width
  double phase = 0.0;      ///< [rad], or the time of a slip as a share of the recording
  int other = 0;           ///< another joint: that whose motion a coupling carries over
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< direction in frame 0, of unit length
};

}  // namespace capstan::test
