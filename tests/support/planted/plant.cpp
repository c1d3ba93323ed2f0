#include "tests/support/planted/plant.h"

#include <cmath>

#include "tests/support/planted/effect_laws.h"

namespace capstan::test {

Plant::Plant(const PlantParameters& parameters, const std::vector<Planted>& effects) : p_(parameters) {
  for (const Planted& planted : effects) {
    const auto joint = static_cast<std::size_t>(planted.joint);
    switch (factsOf(planted.effect).place) {
      case Place::kTransmission:
        if (planted.effect == Effect::kCapstanEccentricity) travel_[joint].push_back(planted);
        if (planted.effect == Effect::kZeroDrift) zero_[joint].push_back(planted);
        break;
      case Place::kCable:
        cable_[joint].push_back(planted);
        break;
      case Place::kFriction:
        friction_[joint].push_back(planted);
        break;
      case Place::kOutside:
        outside_[joint].push_back(planted);
        break;
      default:
        break;
    }
  }
}

Joints Plant::motorsAt(const Joints& q) const {
  Joints q_m{};
  for (int i = 0; i < p_.size; ++i) {
    for (int j = 0; j < p_.size; ++j) q_m[i] += p_.coupling[i][j] * (q[j] - p_.homing[j]);
    q_m[i] *= p_.radius[i] * p_.gear[i] / p_.capstan[i];
  }
  return q_m;
}

PlantState Plant::rest(const Joints& q) {
  PlantState s{};
  s[kJoint] = q;
  s[kMotor] = motorsAt(q);
  p_.chain.pose(q);
  const Joints gravity = p_.chain.bias(Joints{});
  Joints tension{};  // Aᵀ (r ∘ tension) = G, from the last joint to the first where A is lower triangular
  for (int i = p_.size - 1; i >= 0; --i) {
    double rest = gravity[i];
    for (int k = i + 1; k < p_.size; ++k) rest -= p_.coupling[k][i] * p_.radius[k] * tension[k];
    tension[i] = rest / (p_.coupling[i][i] * p_.radius[i]);
    const double compliance = p_.rigid ? p_.compliance[i] : 1.0 / (2.0 * p_.stiffness[i] * p_.exponent[i]);
    s[kMotor][i] += tension[i] * compliance * p_.gear[i] / p_.capstan[i];
  }
  return s;
}

Plant::CableState Plant::cableState(int i, const PlantState& s, double t) const {
  CableState c;
  const double lever = p_.capstan[i] / p_.gear[i];
  c.lever = lever;
  c.travel = lever * s[kMotor][i];
  for (const Planted& e : travel_[i]) {
    const double angle = s[kMotor][i] / p_.gear[i];
    c.travel += law::eccentricTravel(e.magnitude, angle, e.phase);
    c.lever += e.magnitude / p_.gear[i] * std::cos(angle + e.phase);
  }
  c.travel_rate = c.lever * s[kMotorRate][i];
  double link = 0.0, link_rate = 0.0;
  for (int j = 0; j < p_.size; ++j) {
    const double q = s[kJoint][j] - p_.homing[j], dq = s[kJointRate][j];  // from the zero
    link += p_.coupling[i][j] * q;
    link_rate += p_.coupling[i][j] * dq;
  }
  for (const Planted& e : zero_[i]) {  // of the cable, in joint units
    link -= p_.coupling[i][i] * law::settledZero(e.magnitude, t, e.signature);
    link_rate -= p_.coupling[i][i] * law::settlingZero(e.magnitude, t, e.signature);
  }
  c.stretch = c.travel - p_.radius[i] * link;
  c.rate = c.travel_rate - p_.radius[i] * link_rate;
  c.range = (s[kJoint][i] - p_.middle[i]) / p_.half_range[i];
  return c;
}

double Plant::tension(int i, const CableState& c, const PlantState& s, PlantState& slope) const {
  if (p_.rigid) return complianceTension(i, c);
  const double k = p_.stiffness[i], a = p_.exponent[i], b = p_.damping[i];
  double share = 1.0, play = 0.0, stretch = c.stretch, extra = 0.0, pretension = 0.0;
  bool slack = false;
  for (const Planted& e : cable_[i]) {
    if (e.effect == Effect::kPositionStiffness) share *= law::freeLengthShare(e.magnitude, c.range);
    if (e.effect == Effect::kBacklash) play += e.magnitude;
    if (e.effect == Effect::kCableCreep) {
      stretch -= s[kCreep][i];
      slope[kCreep][i] = law::creepRate(s[kCreep][i], stretch, e.magnitude, e.signature);
    }
    if (e.effect == Effect::kCableHysteresis) {
      extra += e.magnitude * s[kHysteresis][i] / e.signature;
      slope[kHysteresis][i] = law::boucWenRate(s[kHysteresis][i], c.rate, e.signature);
    }
    if (e.effect == Effect::kCableStiffening)  // Duffing: k_e a stays for small stretch
      extra += 2.0 * k * a * e.magnitude * stretch * stretch * stretch;
    if (e.effect == Effect::kSlack && e.magnitude != 0.0) {
      slack = true;
      pretension = e.signature * (1.0 - e.magnitude);
    }
  }
  if (slack) return share * law::cablePair(k, a, b, pretension, stretch, c.rate) + extra;
  const double elongation = law::deadZone(stretch, play);
  double force = 2.0 * share * k * std::sinh(a * elongation) + 2.0 * b * c.rate;
  if (play > 0.0) force = law::pressing(force, elongation);
  return force + extra;
}

/// A rigid drive's hidden cable: linear, damped at 10 % of critical with the motor as its mass.
double Plant::complianceTension(int i, const CableState& c) const {
  const double k = 1.0 / p_.compliance[i], lever = p_.capstan[i] / p_.gear[i];
  const double mass = p_.motor_inertia[i] / (lever * lever);
  return k * c.stretch + 0.2 * std::sqrt(k * mass) * c.rate;
}

double Plant::motorFriction(int i, double rate) const {
  return p_.motor_coulomb[i] * std::tanh(rate / p_.motor_smoothing[i]) + p_.motor_viscous[i] * rate;
}

double Plant::jointFriction(int i, double q, double dq, double drive) const {
  const double sign = std::tanh(dq / p_.smoothing[i]);
  double share = 1.0, load = 0.0, viscous = p_.viscous[i];
  for (const Planted& e : friction_[i]) {
    switch (e.effect) {
      case Effect::kStribeckFriction:
        share *= 1.0 + law::stribeckShare(e.magnitude, dq, e.signature);
        break;
      case Effect::kAsymmetricFriction:
        share *= dq > 0.0 ? 1.0 + e.magnitude : 1.0 - e.magnitude;
        break;
      case Effect::kPositionFriction:
        share *= 1.0 + law::positionShare(e.magnitude, q, e.signature, e.phase);
        break;
      case Effect::kLoadFriction:
        load += e.magnitude;
        break;
      case Effect::kViscousFriction:
        viscous += e.magnitude;
        break;
      default:
        break;
    }
  }
  return (p_.coulomb[i] * share + load * std::abs(drive)) * sign + viscous * dq;
}

double Plant::outside(int i, double q, double t) const {
  double torque = 0.0;
  for (const Planted& e : outside_[i]) {
    if (e.effect == Effect::kExternalVibration)
      torque += law::vibration(e.magnitude, e.signature, t, e.phase);
    if (e.effect == Effect::kNonlinearSpring)
      torque += law::hardeningSpring(e.magnitude, (q - p_.middle[i]) / p_.half_range[i]);
    if (e.effect == Effect::kJointDetent) torque += law::detent(e.magnitude, q, e.signature, e.phase);
  }
  return torque;
}

PlantState Plant::slope(const PlantState& s, double t, const PlantInput& input) {
  return slopeWith(bodiesAt(s[kJoint], s[kJointRate]), s, t, input);
}

Plant::Bodies Plant::bodiesAt(const Joints& q, const Joints& dq) {
  p_.chain.pose(q);
  Bodies bodies{p_.chain.massMatrix(), p_.chain.bias(dq)};
  for (int i = 0; i < p_.size; ++i) bodies.mass[i][i] += p_.armature[i];
  return bodies;
}

PlantState Plant::slopeWith(const Bodies& bodies, const PlantState& s, double t,
                            const PlantInput& input) const {
  PlantState d{};
  RigidChain::Matrix mass = bodies.mass;
  Joints drive{}, force{};
  for (int i = 0; i < p_.size; ++i) {
    const double torque = p_.actuator_gain[i] * input.torque[i];
    const CableState cable = cableState(i, s, t);
    double pull = 0.0;  // along the cable [N]
    if (stiff(i)) {
      const double ratio = p_.gear[i] / p_.capstan[i];
      const double rate = ratio * (cable.travel_rate - cable.rate);
      pull = ratio * (torque - motorFriction(i, rate));
      for (int j = 0; j < p_.size; ++j)
        for (int k = 0; k < p_.size; ++k)
          mass[j][k] += p_.coupling[i][j] * p_.coupling[i][k] * p_.motor_inertia[i] * ratio * ratio *
                        p_.radius[i] * p_.radius[i];
    } else {
      pull = tension(i, cable, s, d);
      if (!input.motor) {
        const double rate = s[kMotorRate][i];
        d[kMotor][i] = rate;
        d[kMotorRate][i] = (torque - motorFriction(i, rate) - cable.lever * pull) / p_.motor_inertia[i];
      }
    }
    for (int j = 0; j < p_.size; ++j) drive[j] += p_.coupling[i][j] * p_.radius[i] * pull;
  }
  for (int i = 0; i < p_.size; ++i)
    force[i] = drive[i] - jointFriction(i, s[kJoint][i], s[kJointRate][i], drive[i]) +
               outside(i, s[kJoint][i], t) + input.load[i] - bodies.bias[i];
  d[kJoint] = s[kJointRate];
  d[kJointRate] = solveSymmetric(mass, force, p_.size);
  return d;
}

}  // namespace capstan::test
