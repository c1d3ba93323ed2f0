#include "core/identification/parameters.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/base/error.h"
#include "core/robot/fold_effects.h"
#include "core/tracking/cable_arm_model.h"

namespace capstan::identification {
namespace {

constexpr Quantity kAll[] = {Quantity::kLinkRadius, Quantity::kStiffness, Quantity::kDamping,
                             Quantity::kFriction};

double& valueIn(robot::Description& robot, const Parameter& parameter) {
  const auto joint = static_cast<std::size_t>(parameter.joint);
  robot::Drive& drive = robot.drives[joint];
  switch (parameter.quantity) {
    case Quantity::kLinkRadius:
      return drive.link_radius;
    case Quantity::kStiffness:
      return drive.cable_stiffness;
    case Quantity::kDamping:
      return drive.cable_damping;
    default:
      return robot.joints[joint].friction.coulomb;
  }
}

double& valueIn(tracking::CableArmConstants& c, const Parameter& parameter) {
  return fieldOf(c, parameter.quantity)[parameter.joint];
}

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw base::InputError(
      {{},
       0,
       "parameters",
       name,
       reason,
       "Give names of r_l1…3, k_e1…3, b_e1…3, f_c1…3, or r_l, k_e, b_e, f_c, or all, separated "
       "by commas"});
}

/// Parameters of a name: "k_e2" → one parameter, "k_e" → three, "all" → all twelve.
std::vector<std::pair<Quantity, int>> named(const std::string& name) {
  std::vector<std::pair<Quantity, int>> found;
  for (const Quantity quantity : kAll)
    for (int joint = 0; joint < 3; ++joint) {
      const std::string stem(base::nameOf(quantity));
      if (name == "all" || name == stem || name == stem + std::to_string(joint + 1))
        found.emplace_back(quantity, joint);
    }
  if (found.empty()) refuse(name, "is no parameter");
  return found;
}

/// The robot with its effects folded into its parameters. Camera effects are excepted: tracking compensates
/// them.
robot::Description foldedRobot(const robot::Description& nominal) {
  robot::Description robot = robot::foldEffects(nominal);
  for (const robot::Effect& effect : robot.effects)
    if (!effect.effect.starts_with("camera_") && effect.effect != "sensor_sign")
      throw base::InputError({nominal.name, 0, "effects", effect.effect,
                              "is no number of the model that is identified",
                              "Take it out of the robot file, or identify the nominal robot"});
  return robot;
}

}  // namespace

std::string Parameter::name() const {
  return std::string(base::nameOf(quantity)) + std::to_string(joint + 1);
}

std::string Parameter::words() const {
  const std::string owner = "joint " + std::to_string(joint + 1) + "'s ";
  if (quantity == Quantity::kLinkRadius) return owner + "pulley radius";
  if (quantity == Quantity::kFriction) return owner + "friction";
  return owner + (quantity == Quantity::kStiffness ? "stiffness" : "damping");
}

double Parameter::scale() const { return quantity == Quantity::kLinkRadius && joint < 2 ? 1e3 : 1.0; }

std::string Parameter::unit() const {
  if (quantity == Quantity::kStiffness) return "N";
  if (quantity == Quantity::kFriction) return joint < 2 ? "N·m" : "N";
  if (quantity == Quantity::kDamping) return "N·s/m";
  return joint < 2 ? "mm" : "m/m";
}

ParameterSet::ParameterSet(const robot::Description& nominal, const std::string& names,
                           const ParameterOptions& options)
    : nominal_(foldedRobot(nominal)), constants_(tracking::cableArmConstants(nominal_)) {
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');) {
    std::erase(name, ' ');
    for (const auto& [quantity, joint] : named(name)) {
      const auto same = [&, q = quantity, j = joint](const Parameter& p) {
        return p.quantity == q && p.joint == j;
      };
      if (std::any_of(parameters_.begin(), parameters_.end(), same)) refuse(name, "is requested twice");
      const auto of = static_cast<Eigen::Index>(quantity);
      Parameter parameter{quantity, joint, 0.0, options.prior_sigma(of), options.bound(of), options.goal(of)};
      parameter.nominal = valueIn(constants_, parameter);
      if (!(parameter.nominal > 0.0)) refuse(name, "is zero in the robot file");
      parameters_.push_back(parameter);
    }
  }
  if (parameters_.empty()) refuse(names, "names no parameter");
}

double ParameterSet::value(int i, double log) const { return (*this)[i].nominal * std::exp(log); }

robot::Description ParameterSet::robot(const Logs& logs) const {
  robot::Description robot = nominal_;
  for (int i = 0; i < size(); ++i) {
    const Parameter& parameter = (*this)[i];
    valueIn(robot, parameter) = value(i, logs(i));
  }
  return robot;
}

tracking::CableArmConstants ParameterSet::constants(const Logs& logs) const {
  tracking::CableArmConstants constants = constants_;
  for (int i = 0; i < size(); ++i) valueIn(constants, (*this)[i]) = value(i, logs(i));
  return constants;
}

double ParameterSet::rate(const Logs& logs) const { return tracking::cableArmRate(robot(logs)); }

double ParameterSet::slowestTime() const {
  double slowest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double square = constants_.link_radius[i] * constants_.link_radius[i];
    const double stiffness = 2.0 * constants_.stiffness[i] * constants_.exponent[i] * square;
    const double creep = constants_.coulomb[i] * constants_.inverse_smoothing[i] + constants_.viscous[i];
    slowest = std::max(slowest, (2.0 * constants_.damping[i] * square + creep) / stiffness);
  }
  return slowest;
}

}  // namespace capstan::identification
