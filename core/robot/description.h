#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/field.h"
#include "core/base/names.h"
#include "core/robot/effects.h"
#include "core/robot/joint_vector.h"

namespace capstan::robot {

enum class JointType { kRevolute, kPrismatic };

/// Drive of the joints in a simulation with the robot's model.
enum class DriveType {
  kCable,  ///< motor positions drive the joints through transmission and cables
  kRigid,  ///< motor torques act directly on the joints
};

/// One row of the modified (Craig) Denavit–Hartenberg table: RotX(alpha) TransX(a) RotZ(theta) TransZ(d).
/// A revolute joint's q adds to theta, a prismatic joint's to d.
struct DhRow {
  double alpha = 0.0;  ///< twist alpha_{i-1} [rad]
  double a = 0.0;      ///< link length a_{i-1} [m]
  double d = 0.0;      ///< offset along z_i [m]
  double theta = 0.0;  ///< angle about z_i [rad]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.alpha, {"alpha", "rad", "twist about x of the frame before", {-6.3, 6.3}});
    field(self.a, {"a", "m", "length along x of the frame before", {-10.0, 10.0}});
    field(self.d, {"d", "m", "offset along z of this joint", {-10.0, 10.0}});
    field(self.theta, {"theta", "rad", "angle about z of this joint", {-6.3, 6.3}});
  }
};

/// Rigid link: inertia about the centre of mass, in the axes of the link's own DH frame.
struct Link {
  double mass = 0.0;                                         ///< [kg]
  Eigen::Vector3d centre_of_mass = Eigen::Vector3d::Zero();  ///< [m], link frame
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();         ///< Ixx, Iyy, Izz [kg·m²]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.mass, {"mass", "kg", "mass of the link", {1e-6, 1e3}});
    field(self.centre_of_mass, {"centre_of_mass", "m", "in the link frame", {-10.0, 10.0}});
    field(self.inertia,
          {"inertia", "kg*m^2", "Ixx, Iyy, Izz about the centre of mass, link axes", {0.0, 1e3}});
  }
};

/// Coulomb and viscous friction, sgn(v) smoothed as tanh(v / smoothing).
struct Friction {
  double coulomb = 0.0;    ///< F_cl or tau_cm [N·m or N]
  double viscous = 0.0;    ///< F_vl or tau_vm [N·m·s or N·s/m]
  double smoothing = 0.0;  ///< v_eps [rad/s or m/s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.coulomb, {"coulomb", "N*m or N", "Coulomb friction", {0.0, 1e4}});
    field(self.viscous, {"viscous", "N*m*s or N*s/m", "viscous friction", {0.0, 1e4}});
    field(self.smoothing,
          {"smoothing", "rad/s or m/s", "speed v_eps that smooths sgn(v) into tanh(v / v_eps)", {1e-9, 1e3}});
  }
};

/// One driven joint: geometry, limits, body and friction.
struct Joint {
  std::string name;
  JointType type = JointType::kRevolute;
  DhRow dh;
  double limit_low = 0.0;   ///< lowest position [rad or m]
  double limit_high = 0.0;  ///< highest position [rad or m]
  double homing = 0.0;  ///< q_hs, position at the hard stop [rad or m]; may lie at or just outside the limits
  double max_speed = 0.0;  ///< highest speed [rad/s or m/s]
  Link link;
  Friction friction;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what screens call the joint"});
    field(self.type, {"type", "", "revolute or prismatic"});
    field(self.dh, {"dh", "", "modified Denavit-Hartenberg row"});
    field(self.limit_low, {"limit_low", "rad or m", "lowest position", {-100.0, 100.0}});
    field(self.limit_high, {"limit_high", "rad or m", "highest position", {-100.0, 100.0}});
    field(self.homing, {"homing", "rad or m", "position q_hs at the hard stop", {-100.0, 100.0}});
    field(self.max_speed, {"max_speed", "rad/s or m/s", "highest speed", {1e-6, 1e3}});
    field(self.link, {"link", "", "the rigid body that the joint moves"});
    field(self.friction, {"friction", "", "at the joint: F_cl, F_vl"});
  }
};

/// Motor, gear and cable of one joint, UKF paper (2)–(6).
struct Drive {
  double gear_ratio = 1.0;            ///< N
  double motor_capstan_radius = 0.0;  ///< r_mc [m]
  double link_radius = 0.0;           ///< r_l [m per rad, or m per m]
  double cable_stiffness = 0.0;       ///< k_e [N]
  double cable_damping = 0.0;         ///< b_e [N·s/m]
  double cable_exponent = 1.0;        ///< a [1/m]
  double motor_inertia = 0.0;         ///< I_m [kg·m²]
  Friction motor_friction;            ///< tau_cm, tau_vm
  double motor_torque_limit = 0.0;    ///< [N·m]
  double encoder_counts = 4000.0;     ///< encoder counts per motor revolution

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.gear_ratio, {"gear_ratio", "", "N", {1e-3, 1e4}});
    field(self.motor_capstan_radius, {"motor_capstan_radius", "m", "r_mc", {1e-6, 10.0}});
    field(self.link_radius, {"link_radius", "m/rad or m/m", "r_l", {1e-6, 10.0}});
    field(self.cable_stiffness, {"cable_stiffness", "N", "k_e", {1e-3, 1e9}});
    field(self.cable_damping, {"cable_damping", "N*s/m", "b_e", {0.0, 1e7}});
    field(self.cable_exponent, {"cable_exponent", "1/m", "a in exp(a delta)", {1e-6, 1e6}});
    field(self.motor_inertia, {"motor_inertia", "kg*m^2", "I_m", {1e-9, 1e3}});
    field(self.motor_friction, {"motor_friction", "", "tau_cm, tau_vm"});
    field(self.motor_torque_limit, {"motor_torque_limit", "N*m", "largest motor torque", {1e-6, 1e4}});
    field(self.encoder_counts,
          {"encoder_counts", "1/rev", "motor encoder counts per revolution", {1.0, 1e9}});
  }
};

/// Contents of a robot file. Joints and drives correspond one to one. `coupling` is the n×n matrix A of
/// s_l = r_l ∘ (A (q − q_hs)). Wrist rows continue the DH table after the last driven joint (tool roll,
/// wrist, jaw). `effects` are the effects in the robot beyond this nominal model; each must name an existing
/// joint and suit the drive.
struct Description {
  std::string name;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< in frame 0 [m/s²]
  DriveType drive = DriveType::kCable;
  std::vector<Joint> joints;
  std::vector<Drive> drives;
  std::vector<std::vector<double>> coupling;  ///< rows of A; unit lower triangular for RAVEN-II
  Eigen::Vector3d marker =
      Eigen::Vector3d::Zero();  ///< marker centre in the frame of the last driven joint [m]
  double marker_radius = 0.0;   ///< [m]
  std::vector<DhRow> wrist;
  std::vector<Effect> effects;

  int size() const { return static_cast<int>(joints.size()); }

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what screens call the robot"});
    field(self.gravity, {"gravity", "m/s^2", "gravity in frame 0", {-100.0, 100.0}});
    field(self.drive, {"drive", "", "what drives the joints: cable or rigid", {}, false, true});
    field(self.joints, {"joints", "", "driven joints, base first"});
    field(self.drives, {"drives", "", "motor, gear and cable of each joint"});
    field(self.coupling,
          {"coupling", "rad/rad or m/rad", "matrix A: cable travel by joint travel", {-1e3, 1e3}});
    field(self.marker, {"marker", "m", "marker centre in the frame of the last driven joint", {-10.0, 10.0}});
    field(self.marker_radius, {"marker_radius", "m", "radius of the marker sphere", {1e-5, 1.0}});
    field(self.wrist, {"wrist", "", "passive DH rows behind the driven joints", {}, false});
    field(self.effects, {"effects", "", "what is in the robot beyond the nominal model", {}, false, true});
  }
};

/// Reads and checks a robot file: one to seven joints, as many drives, a square invertible coupling, ordered
/// limits, effects that are known, complete and within their bounds. Throws base::InputError with file, line,
/// key, value and remedy.
Description readDescription(const std::filesystem::path& path);

/// Default robot: the left arm of a RAVEN-II, resources/robots/raven2_left.yaml.
Description defaultDescription();
/// Returns defaultDescription() for an empty path, else readDescription(path).
Description readDescriptionOrDefault(const std::filesystem::path& path);
/// Parses and checks the text of a robot file, as readDescription(); `name` is the file name in errors.
Description parseDescription(const std::string& text, const std::string& name);
/// Text of a robot file for `description`; parseDescription() of it returns the same numbers to the last bit.
std::string formatDescription(const Description& description);

/// Coupling matrix A of a checked description.
JointMatrix couplingMatrix(const Description& description);
/// q_hs of the first three joints [rad or m]; 0 for joints that the robot does not have.
Eigen::Vector3d homingOf(const Description& description);

}  // namespace capstan::robot

template <>
struct capstan::base::NamesOf<capstan::robot::JointType> {
  static constexpr std::array value = {std::pair{capstan::robot::JointType::kRevolute, "revolute"},
                                       std::pair{capstan::robot::JointType::kPrismatic, "prismatic"}};
};
template <>
struct capstan::base::NamesOf<capstan::robot::DriveType> {
  static constexpr std::array value = {std::pair{capstan::robot::DriveType::kCable, "cable"},
                                       std::pair{capstan::robot::DriveType::kRigid, "rigid"}};
};
