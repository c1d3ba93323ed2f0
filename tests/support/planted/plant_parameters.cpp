#include "tests/support/planted/plant_parameters.h"

#include <Eigen/Geometry>
#include <cmath>

namespace capstan::test {
namespace {

/// Between 0.7 and 1.4 to the power of `wear`, as often above 1 as below.
double factor(base::Random& random, double wear) {
  return std::exp(wear * random.uniform(std::log(0.7), std::log(1.4)));
}

/// A base that does not stand level: gravity turned about `axis`.
void tiltGravity(const Planted& planted, PlantParameters& p) {
  if (planted.magnitude == 0.0) return;
  p.chain.setGravity(Eigen::AngleAxisd(planted.magnitude, planted.axis) * p.chain.gravity());
}

}  // namespace

robot::Description worn(const robot::Description& nominal, base::Random& random, double wear) {
  robot::Description robot = nominal;
  for (robot::Joint& joint : robot.joints) {
    const double mass = factor(random, wear);
    joint.link.mass *= mass;
    joint.link.inertia *= mass;
    const double arm = joint.link.centre_of_mass.norm();
    for (int k = 0; k < 3; ++k) joint.link.centre_of_mass(k) += arm * wear * random.uniform(-0.15, 0.15);
    joint.friction.coulomb *= factor(random, wear);
    joint.friction.viscous *= factor(random, wear);
  }
  for (robot::Drive& drive : robot.drives) {
    drive.cable_stiffness *= factor(random, wear);
    drive.cable_damping *= factor(random, wear);
    drive.motor_friction.coulomb *= factor(random, wear);
    drive.motor_friction.viscous *= factor(random, wear);
  }
  return robot;
}

PlantParameters::PlantParameters(const robot::Description& robot, bool rigid_drive)
    : size(robot.size()), rigid(rigid_drive), chain(robot) {
  for (int i = 0; i < size; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const robot::Joint& joint = robot.joints[k];
    const robot::Drive& drive = robot.drives[k];
    gear[i] = drive.gear_ratio;
    capstan[i] = drive.motor_capstan_radius;
    radius[i] = drive.link_radius;
    stiffness[i] = drive.cable_stiffness;
    damping[i] = drive.cable_damping;
    exponent[i] = drive.cable_exponent;
    motor_inertia[i] = drive.motor_inertia;
    motor_coulomb[i] = drive.motor_friction.coulomb;
    motor_viscous[i] = drive.motor_friction.viscous;
    motor_smoothing[i] = drive.motor_friction.smoothing;
    coulomb[i] = joint.friction.coulomb;
    viscous[i] = joint.friction.viscous;
    smoothing[i] = joint.friction.smoothing;
    homing[i] = joint.homing;
    middle[i] = 0.5 * (joint.limit_low + joint.limit_high);
    half_range[i] = 0.5 * (joint.limit_high - joint.limit_low);
    actuator_gain[i] = 1.0;
    for (int j = 0; j < size; ++j) coupling[i][j] = robot.coupling[k][static_cast<std::size_t>(j)];
  }
}

void plantInParameters(const Planted& planted, const robot::Description& nominal, PlantParameters& p) {
  const int i = planted.joint;
  const double m = planted.magnitude;
  switch (planted.effect) {
    case Effect::kPulleyRadius:
      p.radius[i] *= 1.0 + m;
      break;
    case Effect::kCableCoupling:
      p.coupling[i][planted.other] += m;
      break;
    case Effect::kHomingOffset:
      p.homing[i] += m;
      break;
    case Effect::kCableCompliance:
      p.compliance[i] += m;
      break;
    case Effect::kGravityTilt:
      tiltGravity(planted, p);
      break;
    case Effect::kPayload:
      p.chain.addPointMass(p.size - 1, m, nominal.marker);
      break;
    case Effect::kInertia:
      p.armature[i] += m;
      break;
    case Effect::kActuatorGain:
      p.actuator_gain[i] *= 1.0 + m;
      break;
    default:
      break;
  }
}

double frictionStretch(const PlantParameters& p, int i) {
  return p.coulomb[i] / p.radius[i] / (2.0 * p.stiffness[i] * p.exponent[i]);
}

}  // namespace capstan::test
