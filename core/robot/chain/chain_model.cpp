#include "core/robot/chain/chain_model.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "core/robot/chain/chain_bodies.h"
#include "core/robot/chain/chain_law.h"

namespace capstan::robot {
namespace {

constexpr double kGentle = 5.0;  // exponent of a cable [1/m]: 1 cm of stretch changes its law by 4e-4

static_assert(kChainJoints == kMaxJoints);

LinkNumbers<double> linkNumbers(const Link& link) {
  LinkNumbers<double> numbers{};
  const Eigen::Vector3d& c = link.centre_of_mass;
  const double m = link.mass;
  numbers.mass = m;
  for (int k = 0; k < 3; ++k) {
    numbers.moment[k] = m * c[k];
    numbers.inertia[k] = link.inertia[k] + m * (c.squaredNorm() - c[k] * c[k]);  // parallel axes
  }
  numbers.inertia[3] = -m * c[0] * c[1];
  numbers.inertia[4] = -m * c[0] * c[2];
  numbers.inertia[5] = -m * c[1] * c[2];
  return numbers;
}

JointNumbers<double> jointNumbers(const Joint& joint, const Drive& drive) {
  JointNumbers<double> p{};
  p.lever = drive.motor_capstan_radius / drive.gear_ratio;
  p.inverse_gear = 1.0 / drive.gear_ratio;
  p.link_radius = drive.link_radius;
  p.homing = joint.homing;
  p.stiffness = drive.cable_stiffness;
  p.exponent = drive.cable_exponent;
  p.damping = drive.cable_damping;
  p.pretension = kSound;
  p.zero_drift_rate = p.inverse_yield = p.creep_rate = p.inverse_stribeck = p.wave_number = 1.0;
  p.coulomb = joint.friction.coulomb;
  p.viscous = joint.friction.viscous;
  p.inverse_smoothing = 1.0 / joint.friction.smoothing;
  p.gain = p.load_gain = p.length_share = 1.0;
  p.motor_inertia = drive.motor_inertia;
  p.motor_coulomb = drive.motor_friction.coulomb;
  p.motor_viscous = drive.motor_friction.viscous;
  p.inverse_motor_smoothing = 1.0 / drive.motor_friction.smoothing;
  return p;
}

void fillShape(const Description& description, ChainShape& shape) {
  shape.joints = description.size();
  shape.rigid = description.drive == DriveType::kRigid;
  for (int i = 0; i < shape.joints; ++i) {
    const Joint& joint = description.joints[static_cast<std::size_t>(i)];
    shape.revolute[i] = joint.type == JointType::kRevolute;
    shape.sin_alpha[i] = std::sin(joint.dh.alpha);
    shape.cos_alpha[i] = std::cos(joint.dh.alpha);
    shape.a[i] = joint.dh.a;
    shape.d[i] = joint.dh.d;
    shape.theta[i] = joint.dh.theta;
    const double half = 0.5 * (joint.limit_high - joint.limit_low);
    shape.middle[i] = 0.5 * (joint.limit_high + joint.limit_low);
    shape.inverse_half_range[i] = 1.0 / half;
    shape.farthest[i] = 20.0 * half;
    shape.fastest[i] = 20.0 * joint.max_speed;
  }
}

Eigen::Vector3d vectorOf(const Effect& effect) { return {effect["x"], effect["y"], effect["z"]}; }

Eigen::Matrix3d rotationOf(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

void addPayload(const Effect& effect, ChainModel& model) {
  Link point;
  point.mass = effect["mass"];
  point.centre_of_mass = model.marker;
  const LinkNumbers<double> more = linkNumbers(point);
  LinkNumbers<double>& last = model.numbers.links[model.shape.joints - 1];
  last.mass += more.mass;
  for (int k = 0; k < 3; ++k) last.moment[k] += more.moment[k];
  for (int k = 0; k < 6; ++k) last.inertia[k] += more.inertia[k];
}

void tiltGravity(const Effect& effect, ChainModel& model) {
  Eigen::Map<Eigen::Vector3d> gravity(model.numbers.gravity);
  gravity = rotationOf(vectorOf(effect)) * Eigen::Vector3d(gravity);
}

/// Adds an effect of the whole arm or of the cameras. Returns false for any other effect.
bool addWhole(const Effect& effect, ChainModel& model) {
  const std::string& name = effect.effect;
  if (name == "gravity_tilt") {
    tiltGravity(effect, model);
  } else if (name == "payload") {
    addPayload(effect, model);
  } else if (name == "camera_latency") {
    model.camera.delay += effect["delay"];
  } else if (name == "camera_rotation") {
    model.camera.rotation += vectorOf(effect);
  } else if (name == "camera_offset") {
    model.camera.offset += vectorOf(effect);
  } else if (name == "camera_scale") {
    model.camera.scale += effect["share"];
  } else {
    return false;
  }
  return true;
}

void moveZero(const Effect& effect, int i, ChainModel& model) {
  const JointVector shift = homingShift(couplingMatrix(model), i, effect["offset"], effect["at_motor"]);
  for (int j = 0; j < shift.size(); ++j) model.numbers.joints[j].homing += shift[j];
}

void addToTransmission(const Effect& e, JointNumbers<double>& p) {
  const std::string& name = e.effect;
  if (name == "pulley_radius") p.link_radius *= 1.0 + e["share"];
  if (name == "zero_drift") p.zero_drift += e["drift"], p.zero_drift_rate = 1.0 / e["time_constant"];
  if (name == "encoder_slip") p.slip += e["slip"], p.slip_time = e["time"];
  if (name == "capstan_eccentricity") p.eccentric_sine += e["sine"], p.eccentric_cosine += e["cosine"];
}

void addToCable(const Effect& e, bool rigid, JointNumbers<double>& p) {
  const std::string& name = e.effect;
  if (name == "cable_compliance") {
    p.compliance += e["compliance"];
    if (!rigid) p.stiffness /= 1.0 + 2.0 * p.stiffness * p.exponent * e["compliance"];  // springs in series
  }
  if (name == "cable_stiffening") p.stiffening += e["cubic"];
  if (name == "position_stiffness") p.position_stiffness += e["share"], p.length_share = e["of_length"];
  if (name == "backlash") p.play += e["half_width"], p.play_damping = e["damping"];
  if (name == "slack") p.pretension = e["pretension"];
  if (name == "cable_hysteresis") p.hysteresis_force += e["force"], p.inverse_yield = 1.0 / e["yield"];
  if (name == "cable_creep") p.creep_share += e["share"], p.creep_rate = 1.0 / e["time_constant"];
}

void addToFriction(const Effect& e, JointNumbers<double>& p) {
  const std::string& name = e.effect;
  if (name == "stribeck_friction") p.stribeck_excess += e["excess"], p.inverse_stribeck = 1.0 / e["speed"];
  if (name == "asymmetric_friction") p.asymmetry += e["share"];
  if (name == "asymmetric_viscosity") p.viscous_asymmetry += e["share"];
  if (name == "viscous_friction") p.viscous += e["added"];
  if (name == "load_friction") p.load_friction += e["share"];
  if (name == "position_friction") {
    p.wave_sine += e["sine"], p.wave_cosine += e["cosine"];
    p.wave_number = 2.0 * std::numbers::pi / e["period"];
  }
}

void addToBodyAndSensors(const Effect& e, JointNumbers<double>& p) {
  const std::string& name = e.effect;
  if (name == "inertia") p.armature += e["added"];
  if (name == "actuator_gain") p.gain *= 1.0 + e["share"];
  if (name == "torque_offset") p.offset += e["offset"];
  if (name == "sensor_sign")
    p.load_sign = std::abs(e["present"]), p.load_gain = e["present"] < 0.0 ? -1.0 : 1.0;
}

}  // namespace

Eigen::Vector3d CameraNumbers::measure(const Eigen::Vector3d& point) const {
  return (1.0 + scale) * (rotationOf(rotation) * point) + offset;
}

Eigen::Vector3d CameraNumbers::undo(const Eigen::Vector3d& measured) const {
  return rotationOf(rotation).transpose() * (measured - offset) / (1.0 + scale);
}

Eigen::Matrix3d CameraNumbers::undo(const Eigen::Matrix3d& covariance) const {
  const Eigen::Matrix3d turn = rotationOf(rotation);
  return turn.transpose() * covariance * turn / ((1.0 + scale) * (1.0 + scale));
}

ChainModel::ChainModel(const Description& description) : marker(description.marker) {
  fillShape(description, shape);
  for (int i = 0; i < shape.joints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    numbers.joints[i] = jointNumbers(description.joints[at], description.drives[at]);
    if (numbers.joints[i].exponent > kGentle) shape.laws[i] |= kLawExponential;
    numbers.links[i] = linkNumbers(description.joints[at].link);
    for (int j = 0; j < shape.joints; ++j)
      numbers.coupling[i][j] = description.coupling[at][static_cast<std::size_t>(j)];
  }
  for (int k = 0; k < 3; ++k) numbers.gravity[k] = description.gravity[k];
  for (const bool coupling : {true, false})  // the zero of a motor depends on the coupling
    for (const Effect& effect : description.effects)
      if ((effect.effect == "cable_coupling") == coupling) add(effect);
}

void ChainModel::add(const Effect& effect) {
  if (addWhole(effect, *this)) return;
  if (!effectNamed(effect.effect))
    throw base::InputError(
        {"", 0, "effect", effect.effect, "is not a known effect", "See the list of effects"});
  const auto joint = [&](double number, const char* key) {
    if (number >= 1 && number <= shape.joints) return static_cast<int>(std::lround(number)) - 1;
    throw base::InputError({"", 0, key, fmt::format("{:g}", number),
                            fmt::format("is not a joint of the robot, for {}", effect.effect),
                            fmt::format("Choose 1 to {}", shape.joints)});
  };
  const int i = joint(effect.joint, "joint");
  if (effect.effect == "cable_coupling")
    numbers.coupling[i][joint(effect["other"], "other")] += effect["added"];
  if (effect.effect == "homing_offset") moveZero(effect, i, *this);
  addToTransmission(effect, numbers.joints[i]);
  addToCable(effect, shape.rigid, numbers.joints[i]);
  addToFriction(effect, numbers.joints[i]);
  addToBodyAndSensors(effect, numbers.joints[i]);
  const bool series = effect.effect == "cable_compliance" && !shape.rigid;
  if (!series) shape.laws[i] |= lawOf(effect.effect);
}

JointMatrix couplingMatrix(const ChainModel& model) {
  const int n = model.shape.joints;
  JointMatrix matrix(n, n);
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) matrix(row, column) = model.numbers.coupling[row][column];
  return matrix;
}

JointVector homingShift(const JointMatrix& coupling, int i, double offset, double at_motor) {
  JointVector shift = JointVector::Zero(coupling.rows());
  shift[i] = (1.0 - at_motor) * offset;
  if (at_motor == 0.0) return shift;
  JointVector travel = JointVector::Zero(coupling.rows());
  travel[i] = coupling(i, i) * at_motor * offset;
  return shift + coupling.partialPivLu().solve(travel);
}

unsigned lawOf(std::string_view effect) {
  static constexpr std::pair<std::string_view, unsigned> kLaws[] = {
      {"capstan_eccentricity", kLawEccentricity},
      {"encoder_slip", kLawSlip},
      {"zero_drift", kLawZeroDrift},
      {"cable_stiffening", kLawStiffening},
      {"position_stiffness", kLawPositionStiffness},
      {"backlash", kLawPlay},
      {"slack", kLawSlack},
      {"cable_hysteresis", kLawHysteresis},
      {"cable_creep", kLawCreep},
      {"stribeck_friction", kLawStribeck},
      {"asymmetric_friction", kLawAsymmetry},
      {"asymmetric_viscosity", kLawAsymmetricViscosity},
      {"load_friction", kLawLoadFriction},
      {"position_friction", kLawWave},
      {"cable_compliance", kLawCompliance}};
  const auto* found =
      std::find_if(std::begin(kLaws), std::end(kLaws), [&](const auto& law) { return law.first == effect; });
  return found == std::end(kLaws) ? 0u : found->second;
}

namespace {

/// Slope of a joint's friction at rest [N·m·s/rad or N·s/m]. `weight` is the load of gravity on the joint.
double steepestFriction(const JointNumbers<double>& p, double weight) {
  const double wave = std::hypot(p.wave_sine, p.wave_cosine);
  const double coulomb =
      p.coulomb * (1.0 + std::max(p.stribeck_excess, 0.0)) * (1.0 + std::abs(p.asymmetry)) * (1.0 + wave);
  const double load = p.load_friction * (std::abs(weight) + 2.0 * p.coulomb);
  return (coulomb + load) * p.inverse_smoothing + p.viscous * (1.0 + std::abs(p.viscous_asymmetry));
}

ChainBodies<double> bodiesAtRest(const ChainModel& model, const JointVector& q) {
  double at[kChainJoints] = {}, still[kChainJoints] = {};
  for (int i = 0; i < model.shape.joints; ++i) at[i] = q[i];
  ChainBodies<double> bodies{};
  chainBodies<double>(model.shape, model.numbers, at, still, bodies);
  return bodies;
}

JointMatrix massWithArmature(const ChainModel& model, const ChainBodies<double>& bodies) {
  const int n = model.shape.joints;
  JointMatrix mass(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      mass(i, j) = bodies.mass[i][j] + (i == j ? model.numbers.joints[i].armature : 0.0);
  return mass;
}

/// Stiffness, damping and inertia of a joint's drive along its cable [N/m, N·s/m, kg], and its motor's rates.
struct DriveRates {
  double stiffness = 0.0, damping = 0.0, inertia = 0.0;
  double outside = 0.0;  ///< the stiffness where ChainStep's Jacobian does not contain all of it
  double motor_spring = 0.0, motor_damping = 0.0;  ///< divided by the motor's inertia [1/s², 1/s]
};

DriveRates driveRates(const JointNumbers<double>& p, bool rigid, unsigned laws) {
  DriveRates rates;
  if (!rigid) {
    constexpr double kHarder = 4.0;  // factor of the stiffness of a stiffening cable at its largest load
    const double harder = p.stiffening > 0.0 ? kHarder : 1.0;
    const double shorter = std::max(positionShare(p, -1.2), positionShare(p, 1.2));
    rates.stiffness =
        2.0 * p.stiffness * p.exponent * harder * shorter + p.hysteresis_force * p.inverse_yield;
    rates.outside = p.hysteresis_force > 0.0 ? rates.stiffness : 0.0;
    rates.damping = 2.0 * p.damping;
    return rates;
  }
  const double friction = p.motor_coulomb * p.inverse_motor_smoothing + p.motor_viscous;
  if (!(laws & kLawCompliance)) {
    rates.damping = friction / (p.lever * p.lever);
    rates.inertia = p.motor_inertia / (p.lever * p.lever);
    return rates;
  }
  rates.stiffness = rates.outside = 1.0 / p.compliance;
  rates.damping = 0.2 / p.lever * std::sqrt(rates.stiffness * p.motor_inertia);
  rates.motor_spring = p.lever * p.lever * rates.stiffness / p.motor_inertia;
  rates.motor_damping = (friction + p.lever * p.lever * rates.damping) / p.motor_inertia;
  return rates;
}

double largestEigenvalue(const JointMatrix& a, const JointMatrix& mass) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<JointMatrix>(a, mass, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace

JointMatrix massMatrix(const ChainModel& model, const JointVector& q) {
  return massWithArmature(model, bodiesAtRest(model, q));
}

namespace {

struct ChainRates {
  double damping = 0.0;  ///< rate of the damping of joints and cables [1/s]
  double turning = 0.0;  ///< rate of the springs [1/s]
  double outside = 0.0;  ///< rate of those that ChainStep's Jacobian does not contain in full [1/s]
  double motor = 0.0;    ///< rate of the damping of compliant motors [1/s]
};

ChainRates chainRates(const ChainModel& model, const JointVector& q) {
  const int n = model.shape.joints;
  const ChainBodies<double> bodies = bodiesAtRest(model, q);
  JointMatrix mass = massWithArmature(model, bodies), spring = JointMatrix::Zero(n, n), damping = spring,
              outside = spring;
  double motor_spring = 0.0, motor_damping = 0.0;
  for (int i = 0; i < n; ++i) {
    const JointNumbers<double>& p = model.numbers.joints[i];
    const DriveRates drive = driveRates(p, model.shape.rigid, model.shape.laws[i]);
    JointVector row(n);
    for (int j = 0; j < n; ++j) row[j] = p.link_radius * model.numbers.coupling[i][j];
    const JointMatrix lever = row * row.transpose();
    spring += drive.stiffness * lever;
    outside += drive.outside * lever;
    damping += drive.damping * lever;
    mass += drive.inertia * lever;
    damping(i, i) += steepestFriction(p, bodies.bias[i]);
    motor_spring = std::max(motor_spring, drive.motor_spring);
    motor_damping = std::max(motor_damping, drive.motor_damping);
  }
  return {largestEigenvalue(damping, mass), std::sqrt(largestEigenvalue(spring, mass) + motor_spring),
          std::sqrt(largestEigenvalue(outside, mass) + motor_spring), motor_damping};
}

}  // namespace

double chainRate(const ChainModel& model, const JointVector& q) {
  const ChainRates rates = chainRates(model, q);
  return std::max(rates.damping + rates.motor, rates.turning);
}

double chainOscillation(const ChainModel& model, const JointVector& q) {
  const ChainRates rates = chainRates(model, q);
  return std::max(rates.outside, rates.motor);
}

}  // namespace capstan::robot
