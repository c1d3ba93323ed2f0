#include "core/identification/drive_parameters.h"

#include "core/base/error.h"
#include "core/base/units.h"

namespace capstan::identification {
namespace {

using Q = DriveQuantity;

struct Width {
  double prior_sigma, bound;  ///< prior σ and bound of the logarithm
};

/// Priors: gear ratios are known to some per cent, cables and friction hardly to an order of magnitude.
constexpr Width widthOf(Q quantity) { return quantity == Q::kLinkRadius ? Width{0.1, 0.5} : Width{2.0, 8.0}; }

std::array<double, kDriveQuantities> valuesOf(const robot::Description& robot) {
  const robot::Drive& drive = robot.drives.front();
  const robot::Friction& joint = robot.joints.front().friction;
  return {drive.link_radius,
          2.0 * drive.cable_stiffness * drive.cable_exponent,
          drive.cable_exponent,
          drive.cable_damping,
          joint.coulomb,
          joint.viscous,
          drive.motor_friction.coulomb,
          drive.motor_friction.viscous};
}

[[noreturn]] void refuseName(const std::string& name, const std::string& reason) {
  throw base::InputError(
      {"--parameters", 0, {}, name, reason, std::string("Choose from ") + kAllDriveParameters + ", or all"});
}

std::optional<Q> quantityOf(std::string name) {
  if (!name.empty() && name.back() == '1') name.pop_back();
  return base::fromName<Q>(name == "k_e" ? "k_c" : name);
}

std::vector<std::string> split(const std::string& names) {
  std::vector<std::string> parts(1);
  for (const char c : names) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ')
      parts.back() += c;
  }
  return parts;
}

}  // namespace

std::string DriveParameter::name() const { return std::string(base::nameOf(quantity)); }

std::string DriveParameter::words() const {
  static constexpr std::array<const char*, kDriveQuantities> kWords = {
      "the pulley radius",        "the cable's stiffness",       "the cable's stiffening",
      "the cable's damping",      "the joint's dry friction",    "the joint's viscous friction",
      "the motor's dry friction", "the motor's viscous friction"};
  return kWords[static_cast<std::size_t>(quantity)];
}

double DriveParameter::scale() const {
  return quantity == Q::kLinkRadius && !sliding ? base::toMillimetres(1.0) : 1.0;
}

std::string DriveParameter::unit() const {
  switch (quantity) {
    case Q::kLinkRadius:
      return sliding ? "m/m" : "mm";
    case Q::kStiffness:
      return "N/m";
    case Q::kExponent:
      return "1/m";
    case Q::kDamping:
      return "N·s/m";
    case Q::kCoulomb:
      return sliding ? "N" : "N·m";
    case Q::kViscous:
      return sliding ? "N·s/m" : "N·m·s";
    case Q::kMotorCoulomb:
      return "N·m";
    default:
      return "N·m·s";
  }
}

DriveParameters::DriveParameters(const robot::Description& nominal, const std::string& names)
    : nominal_(nominal) {
  if (nominal.size() != 1)
    throw base::InputError({"--robot", 0, "joints",
                            nominal.name + ", " + std::to_string(nominal.size()) + " joints",
                            "is no robot of one joint", "Give the robot file of a single drive"});
  const auto values = valuesOf(nominal);
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto quantity = static_cast<Q>(i);
    const Width width = widthOf(quantity);
    parameters_[i] = {quantity,    nominal.joints.front().type == robot::JointType::kPrismatic,
                      values[i],   width.prior_sigma,
                      width.bound, names == "all"};
  }
  if (names != "all")
    for (const std::string& name : split(names)) {
      const auto quantity = quantityOf(name);
      if (!quantity) refuseName(name, "is no parameter of a drive");
      DriveParameter& parameter = parameters_[static_cast<std::size_t>(*quantity)];
      if (parameter.asked) refuseName(name, "comes twice");
      parameter.asked = true;
    }
  for (const DriveParameter& parameter : parameters_)
    if (parameter.asked && !(parameter.nominal > 0.0))
      throw base::InputError(
          {"--robot", 0, parameter.name(), "0",
           "is zero in the robot file: identification changes it by a factor",
           "Give a small positive value, or leave " + parameter.name() + " out of --parameters"});
}

robot::Description DriveParameters::robot(const DriveLogs& logs, double offset) const {
  robot::Description robot = nominal_;
  const DriveLaw<double> law = this->law<double>(logs.data());
  robot::Drive& drive = robot.drives.front();
  drive.link_radius = law.link_radius;
  drive.cable_stiffness = 0.5 * law.stiffness / law.exponent;
  drive.cable_exponent = law.exponent;
  drive.cable_damping = law.damping;
  robot.joints.front().friction.coulomb = law.coulomb;
  robot.joints.front().friction.viscous = law.viscous;
  drive.motor_friction.coulomb = law.motor_coulomb;
  drive.motor_friction.viscous = law.motor_viscous;
  robot.joints.front().homing += offset;
  return robot;
}

}  // namespace capstan::identification
