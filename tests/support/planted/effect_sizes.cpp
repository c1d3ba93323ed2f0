#include "tests/support/planted/effect_sizes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/support/planted/turn.h"

namespace capstan::test {
namespace {

double eitherSign(base::Random& random) { return random.bits() & 1U ? 1.0 : -1.0; }

Eigen::Vector3d anyDirection(base::Random& random) {
  Eigen::Vector3d v;
  do v = Eigen::Vector3d(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
  while (v.norm() > 1.0 || v.norm() < 0.1);
  return v.normalized();
}

/// Across gravity, so that a tilt about it is one.
Eigen::Vector3d levelAxis(const Eigen::Vector3d& gravity, base::Random& random) {
  if (gravity.norm() == 0.0) return Eigen::Vector3d::UnitX();
  for (;;) {
    const Eigen::Vector3d across = anyDirection(random).cross(gravity.normalized());
    if (across.norm() > 0.3) return across.normalized();
  }
}

double totalMass(const robot::Description& robot) {
  double mass = 0.0;
  for (const robot::Joint& joint : robot.joints) mass += joint.link.mass;
  return mass;
}

double inertiaAtRest(const PlantParameters& p, int i) {
  RigidChain chain = p.chain;
  chain.pose(p.middle);
  return chain.massMatrix()[i][i];
}

/// Largest stretch that gravity in any pose and twice the Coulomb friction make together [m].
double peakStretch(const PlantParameters& p, int i) {
  RigidChain chain = p.chain;
  double gravity = 0.0;
  for (int pose = 0; pose < 64; ++pose) {  // every joint walks over its range at a step of its own
    Joints q{};
    for (int j = 0; j < p.size; ++j)
      q[j] = p.middle[j] + p.half_range[j] * std::cos(0.7 + pose * (1.0 + 0.37 * j));
    chain.pose(q);
    gravity = std::max(gravity, std::abs(chain.bias(Joints{})[i]));
  }
  return frictionStretch(p, i) * (2.0 + gravity / p.coulomb[i]);
}

double topSpeed(const robot::Description& robot, int i) {
  return robot.joints[static_cast<std::size_t>(i)].max_speed;
}

/// Effects of what leads from the motor to the cable.
void plausibleTransmission(Planted& e, const PlantParameters& p, base::Random& random) {
  const int i = e.joint;
  const double range = 2.0 * p.half_range[i];
  switch (e.effect) {
    case Effect::kPulleyRadius:
      e.magnitude = 0.08 * eitherSign(random);
      break;
    case Effect::kCableCoupling:
      e.other = i > 0 ? static_cast<int>(random.bits() % static_cast<unsigned>(i)) : 0;
      e.magnitude = 0.08 * eitherSign(random) * range / (2.0 * p.half_range[e.other]);
      break;
    case Effect::kHomingOffset:
      e.magnitude = 0.03 * range * eitherSign(random);
      break;
    case Effect::kZeroDrift:
      e.magnitude = 0.03 * range * eitherSign(random);
      e.signature = random.uniform(2.0, 6.0);  // [s]
      break;
    case Effect::kEncoderSlip:
      e.magnitude = 0.03 * range * p.radius[i] * p.gear[i] / p.capstan[i] * eitherSign(random);
      e.signature = 0.05;  // it slips within so many seconds
      e.phase = random.uniform(0.25, 0.75);
      break;
    case Effect::kCapstanEccentricity:
      e.magnitude = 0.1 * p.capstan[i];
      e.phase = random.uniform(0.0, kTurn);
      break;
    default:
      break;
  }
}

void plausibleCable(Planted& e, const PlantParameters& p, base::Random& random) {
  const int i = e.joint;
  const double stretch = frictionStretch(p, i);
  switch (e.effect) {
    case Effect::kCableCompliance: {
      const double slowest = kTurn * 2.5;  // of the link on its cable [rad/s]
      e.magnitude = p.radius[i] * p.radius[i] / (inertiaAtRest(p, i) * slowest * slowest);
      break;
    }
    case Effect::kCableStiffening:
      e.magnitude = 3.0 / (stretch * stretch);
      break;
    case Effect::kPositionStiffness:
      e.magnitude = 0.7 * eitherSign(random);
      break;
    case Effect::kBacklash:
      e.magnitude = 0.01 * p.radius[i] * 2.0 * p.half_range[i];
      break;
    case Effect::kSlack:
      e.magnitude = 0.95;                     // without any, the pair is half as stiff wherever it is
      e.signature = 1.5 * peakStretch(p, i);  // pretension stretch of the sound pair
      break;
    case Effect::kCableHysteresis:
      e.magnitude = 2.0 * p.coulomb[i] / p.radius[i];
      e.signature = stretch * random.uniform(0.2, 0.5);  // yield
      break;
    case Effect::kCableCreep:
      e.magnitude = 1.5;
      e.signature = random.uniform(0.7, 4.0);  // [s]
      break;
    default:
      break;
  }
}

void plausibleFriction(Planted& e, const PlantParameters& p, double top_speed, base::Random& random) {
  const int i = e.joint;
  switch (e.effect) {
    case Effect::kStribeckFriction:
      e.magnitude = 3.0;
      e.signature = top_speed * random.uniform(0.02, 0.06);
      break;
    case Effect::kAsymmetricFriction:
      e.magnitude = 0.7 * eitherSign(random);
      break;
    case Effect::kViscousFriction:
      e.magnitude = 4.0 * p.coulomb[i] / (0.3 * top_speed);
      break;
    case Effect::kLoadFriction:
      e.magnitude = 0.5;
      break;
    case Effect::kPositionFriction:
      e.magnitude = 0.9;
      e.signature = 2.0 * p.half_range[i] * random.uniform(0.3, 0.7);
      e.phase = random.uniform(0.0, kTurn);
      break;
    default:
      break;
  }
}

void plausibleRest(Planted& e, const PlantParameters& p, const robot::Description& nominal,
                   base::Random& random) {
  const int i = e.joint;
  const double range = 2.0 * p.half_range[i];
  switch (e.effect) {
    case Effect::kGravityTilt:
      e.magnitude = 0.26;
      break;
    case Effect::kPayload:
      e.magnitude = 0.5 * totalMass(nominal);
      break;
    case Effect::kInertia:
      e.magnitude = 3.0 * inertiaAtRest(p, i);
      break;
    case Effect::kActuatorGain:
      e.magnitude = 0.25 * eitherSign(random);
      break;
    case Effect::kCameraLatency:
      e.magnitude = 0.08;
      break;
    case Effect::kCameraRotation:
      e.magnitude = 0.06;
      break;
    case Effect::kCameraOffset:
      e.magnitude = 0.012;
      break;
    case Effect::kCameraScale:
      e.magnitude = 0.06 * eitherSign(random);
      break;
    case Effect::kSensorSign:
      e.magnitude = 1.0;
      break;
    case Effect::kExternalVibration:
      e.magnitude = 4.0 * p.coulomb[i];
      e.signature = random.uniform(3.0, 12.0);  // [Hz]
      e.phase = random.uniform(0.0, kTurn);
      break;
    case Effect::kNonlinearSpring:
      e.magnitude = 12.0 * p.coulomb[i];
      break;
    case Effect::kJointDetent:
      e.magnitude = 4.0 * p.coulomb[i];
      e.signature = range / random.uniform(6.0, 12.0);
      e.phase = random.uniform(0.0, kTurn);
      break;
    case Effect::kEncoderDrift:
      e.magnitude = 0.02 * range / 30.0 * eitherSign(random);
      break;
    default:
      break;
  }
}

}  // namespace

Planted largestPlausible(Effect effect, int i, const PlantParameters& p, const robot::Description& nominal,
                         base::Random& random) {
  Planted e;
  e.effect = effect;
  e.joint = i;
  e.axis = effect == Effect::kGravityTilt ? levelAxis(p.chain.gravity(), random) : anyDirection(random);
  switch (factsOf(effect).place) {
    case Place::kTransmission:
      plausibleTransmission(e, p, random);
      break;
    case Place::kCable:
      plausibleCable(e, p, random);
      break;
    case Place::kFriction:
      plausibleFriction(e, p, topSpeed(nominal, i), random);
      break;
    default:
      plausibleRest(e, p, nominal, random);
      break;
  }
  return e;
}

std::vector<Planted> backgroundTexture(const PlantParameters& p, base::Random& random, double factor) {
  std::vector<Planted> texture;
  for (int i = 0; i < p.size; ++i) {
    Planted e;
    e.joint = i;
    e.effect = Effect::kAsymmetricFriction;
    e.magnitude = factor * random.uniform(0.01, 0.04) * eitherSign(random);
    texture.push_back(e);
    e.effect = Effect::kStribeckFriction;
    e.magnitude = factor * random.uniform(0.01, 0.05);
    e.signature = 6.0 * p.smoothing[i];
    texture.push_back(e);
    if (p.rigid) continue;
    e.effect = Effect::kCapstanEccentricity;
    e.magnitude = factor * random.uniform(0.2e-3, 1e-3) * p.capstan[i];
    e.phase = random.uniform(0.0, kTurn);
    texture.push_back(e);
  }
  return texture;
}

double visibilityOf(double size, double most) {
  if (size > 1.0) return size * kLargeVisibility;
  const double large = std::min(kLargeVisibility, most);
  return large > 1.0 ? std::pow(large, 1.0 + std::log10(size)) : size * large;
}

Sized sizedTo(double size, const Planted& largest, const Visibility& visibility) {
  const double most = visibility.of(largest);
  if (largest.effect == Effect::kSensorSign) return {largest, most};
  const double wanted = visibilityOf(size, most);
  if (wanted >= most) return {largest, most};
  // Regula falsi on logarithms between shares of the largest that show too little and too much.
  double low = 0.0, high = 1.0, seen_low = 0.0, seen_high = most;
  Sized sized{largest, most};
  for (int round = 0; round < 10 && !(sized.visibility > 0.8 * wanted && sized.visibility < 1.25 * wanted);
       ++round) {
    double share = std::min(high * wanted / seen_high, 0.98 * high);
    if (seen_low > 0.0) {
      const double width = std::log(high / low);
      const double power = width / std::max(std::log(seen_high / seen_low), 1e-3);
      share = low * std::exp(std::clamp(power * std::log(wanted / seen_low), 0.05 * width, 0.95 * width));
    } else if (low > 0.0) {
      share = std::sqrt(low * high);
    }
    sized.planted.magnitude = largest.magnitude * share;
    sized.visibility = visibility.of(sized.planted);
    (sized.visibility < wanted ? low : high) = share;
    (sized.visibility < wanted ? seen_low : seen_high) = sized.visibility;
  }
  return sized;
}

}  // namespace capstan::test
