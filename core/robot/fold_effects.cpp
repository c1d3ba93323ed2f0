#include "core/robot/fold_effects.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/robot/chain/chain_model.h"

namespace capstan::robot {
namespace {

using Eigen::Vector3d;

/// Adds a payload to the link. Returns false when products of inertia would arise.
bool addPayload(double mass, const Vector3d& at, Link& link) {
  const Vector3d apart = at - link.centre_of_mass;
  const double whole = link.mass + mass, reduced = link.mass * mass / whole;
  const double products =
      std::abs(apart.x() * apart.y()) + std::abs(apart.x() * apart.z()) + std::abs(apart.y() * apart.z());
  if (products > 1e-12 * apart.squaredNorm() || whole <= 0.0) return false;
  link.centre_of_mass += mass / whole * apart;
  link.mass = whole;
  for (int k = 0; k < 3; ++k) link.inertia[k] += reduced * (apart.squaredNorm() - apart[k] * apart[k]);
  return true;
}

void addHomingShift(const Effect& effect, Description& robot) {
  const JointVector shift =
      homingShift(couplingMatrix(robot), effect.joint - 1, effect["offset"], effect["at_motor"]);
  for (int j = 0; j < robot.size(); ++j) robot.joints[static_cast<std::size_t>(j)].homing += shift[j];
}

bool foldOne(const Effect& effect, Description& robot) {
  const std::string& name = effect.effect;
  if (name == "gravity_tilt") {
    const Vector3d vector(effect["x"], effect["y"], effect["z"]);
    if (vector.norm() > 0.0)
      robot.gravity = Eigen::AngleAxisd(vector.norm(), vector.normalized()) * robot.gravity;
    return true;
  }
  if (name == "payload") return addPayload(effect["mass"], robot.marker, robot.joints.back().link);
  if (effect.joint < 1 || effect.joint > robot.size()) return false;
  const auto i = static_cast<std::size_t>(effect.joint - 1);
  Drive& drive = robot.drives[i];
  if (name == "pulley_radius") {
    drive.link_radius *= 1.0 + effect["share"];
  } else if (name == "cable_coupling") {
    robot.coupling[i][static_cast<std::size_t>(std::lround(effect["other"])) - 1] += effect["added"];
  } else if (name == "homing_offset") {
    addHomingShift(effect, robot);
  } else if (name == "viscous_friction") {
    robot.joints[i].friction.viscous += effect["added"];
  } else if (name == "cable_compliance" && robot.drive == DriveType::kCable) {
    drive.cable_stiffness /= 1.0 + 2.0 * drive.cable_stiffness * drive.cable_exponent * effect["compliance"];
  } else {
    return false;
  }
  return true;
}

}  // namespace

Description foldEffects(Description description) {
  std::vector<Effect> effects;
  effects.swap(description.effects);
  std::stable_partition(effects.begin(), effects.end(), [](const Effect& effect) {
    return effect.effect == "cable_coupling";
  });  // for homing errors
  for (Effect& effect : effects)
    if (!foldOne(effect, description)) description.effects.push_back(std::move(effect));
  return description;
}

}  // namespace capstan::robot
