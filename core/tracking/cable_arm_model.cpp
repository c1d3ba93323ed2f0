#include "core/tracking/cable_arm_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/robot/arm_dynamics.h"
#include "core/robot/fold_effects.h"

namespace capstan::tracking {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d couplingOf(const robot::Description& robot) {
  Matrix3d a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      a(i, j) = robot.coupling[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return a;
}

/// Aᵀ diag(r_l² value) A: a diagonal cable property, transformed to the joints.
Matrix3d atJoints(const Matrix3d& coupling, const Vector3d& radius, const Vector3d& value) {
  return coupling.transpose() * radius.cwiseAbs2().cwiseProduct(value).asDiagonal() * coupling;
}

double largestEigenvalue(const Matrix3d& a, const Matrix3d& mass) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix3d>(a, mass, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

}  // namespace

CableArmConstants cableArmConstants(const robot::Description& robot) {
  CableArmConstants c{};
  c.body = robot::armConstants(robot);
  const Matrix3d coupling = couplingOf(robot);
  for (int i = 0; i < 3; ++i) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const robot::Drive& drive = robot.drives[static_cast<std::size_t>(i)];
    for (int j = 0; j < 3; ++j) c.coupling[i][j] = coupling(i, j);
    c.homing[i] = joint.homing;
    c.link_radius[i] = drive.link_radius;
    c.motor_scale[i] = drive.motor_capstan_radius / drive.gear_ratio;
    c.stiffness[i] = drive.cable_stiffness;
    c.exponent[i] = drive.cable_exponent;
    c.damping[i] = drive.cable_damping;
    c.coulomb[i] = joint.friction.coulomb;
    c.viscous[i] = joint.friction.viscous;
    c.inverse_smoothing[i] = 1.0 / joint.friction.smoothing;
    const double range = joint.limit_high - joint.limit_low;
    c.low[2 * i] = joint.limit_low - range;
    c.high[2 * i] = joint.limit_high + range;
    c.high[2 * i + 1] = 10.0 * joint.max_speed;
    c.low[2 * i + 1] = -c.high[2 * i + 1];
  }
  return c;
}

double cableArmRate(const robot::Description& robot) {
  const robot::ArmDynamics dynamics(robot);
  const Matrix3d coupling = couplingOf(robot);
  Vector3d radius, damping, stiffness, friction, low, high;
  for (int i = 0; i < 3; ++i) {
    const robot::Joint& joint = robot.joints[static_cast<std::size_t>(i)];
    const robot::Drive& drive = robot.drives[static_cast<std::size_t>(i)];
    radius(i) = drive.link_radius;
    damping(i) = 2.0 * drive.cable_damping;
    stiffness(i) = 2.0 * drive.cable_stiffness * drive.cable_exponent;
    friction(i) = joint.friction.coulomb / joint.friction.smoothing + joint.friction.viscous;
    low(i) = joint.limit_low;
    high(i) = joint.limit_high;
  }
  const Matrix3d d = atJoints(coupling, radius, damping) + Matrix3d(friction.asDiagonal());
  const Matrix3d k = atJoints(coupling, radius, stiffness);

  constexpr int kGrid = 8;
  double rate = 0.0;
  for (int i = 0; i <= kGrid; ++i)
    for (int j = 0; j <= kGrid; ++j) {
      Vector3d q = low;  // M does not depend on q1
      q(1) += (high(1) - low(1)) * i / kGrid;
      q(2) += (high(2) - low(2)) * j / kGrid;
      const Matrix3d mass = dynamics.massMatrix<double>(q);
      rate = std::max({rate, largestEigenvalue(d, mass), std::sqrt(largestEigenvalue(k, mass))});
    }
  return rate;
}

CableArmModel::CableArmModel(const robot::Description& robot, math::InstructionSet set)
    : constants_(cableArmConstants(robot::foldEffects(robot))),
      kernel_(&cableArmKernel(set)),
      rate_(cableArmRate(robot::foldEffects(robot))) {
  if (robot.drive != robot::DriveType::kCable)
    throw base::InputError({robot.name, 0, "drive", "rigid", "has no cables, which the filter models",
                            "Give a robot file with drive: cable"});
  if (!ExtendedArmModel::isNeededFor(robot)) return;
  extended_ = std::make_shared<const ExtendedArmModel>(robot, constants_.low, constants_.high, set);
  rate_ = std::max(rate_, extended_->rate());
}

CableArmModel::Input CableArmModel::interval(const Control& start, const Control& end) {
  Input input;
  Eigen::Map<Vector3d>(input.position0) = start.correction.position(start.position);
  Eigen::Map<Vector3d>(input.velocity0) = start.correction.velocity(start.velocity);
  Eigen::Map<Vector3d>(input.position1) = end.correction.position(end.position);
  Eigen::Map<Vector3d>(input.velocity1) = end.correction.velocity(end.velocity);
  input.unknown = start.unknown | end.unknown;
  input.blind = end.blind;
  input.memory = start.memory;
  return input;
}

CableArmModel::Control CableArmModel::between(const Control& start, const Control& end, double fraction) {
  return {start.position + fraction * (end.position - start.position),
          start.velocity + fraction * (end.velocity - start.velocity),
          start.unknown | end.unknown,
          start.blind + fraction * (end.blind - start.blind),
          {start.memory.hysteresis + fraction * (end.memory.hysteresis - start.memory.hysteresis),
           start.memory.creep + fraction * (end.memory.creep - start.memory.creep)},
          end.correction};
}

void CableArmModel::propagateUnknown(Points& points, const Input& input, double dt) const {
  CableArmUnknown unknown;
  for (int i = 0; i < 3; ++i) {
    unknown.motor[i] = contains(input.unknown, i);
    unknown.decay[i] = unknown_motion_.decay(input.blind);
  }
  kernel_->propagateUnknown(constants_, unknown, input, dt, stepsFor(dt), points.data());
}

CableArmModel::Density CableArmModel::density(const Input& input, const Density& density) const {
  if (input.unknown == 0) return density;
  Density changed = density;
  const Vector3d random = unknown_motion_.density(input.blind);
  for (int joint = 0; joint < 3; ++joint) {
    if (!contains(input.unknown, joint)) continue;
    changed.middleRows<2>(2 * joint).setZero();
    changed(2 * joint + 1, 2 * joint + 1) = random(joint);
  }
  return changed;
}

int CableArmModel::stepsFor(double dt) const {
  constexpr double kMost = 1000.0;  // a gap in the samples must not stall the pipeline
  if (fixed_steps_ > 0) return fixed_steps_;
  return static_cast<int>(std::clamp(std::ceil(0.5 * dt * rate_), 1.0, kMost));
}

CableMemory CableArmModel::remember(const State& x, const Input& input, double dt) const {
  if (!extended_ || input.unknown != 0) return input.memory;
  return extended_->remember(x, input, input.memory, dt);
}

CableArmModel::State CableArmModel::propagateOne(const State& x, const Input& input, double dt) const {
  alignas(64) Points points;
  points.colwise() = x;
  propagate(points, input, dt);
  return points.col(0);
}

}  // namespace capstan::tracking
