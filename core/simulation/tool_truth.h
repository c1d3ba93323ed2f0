#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>

#include "core/base/field.h"
#include "core/robot/description.h"
#include "core/robot/tool_kinematics.h"

/// What a simulated seven-joint arm and the cameras that see its tool really are, as against the nominal
/// robot file that its controller assumes. Default-constructed: the nominal robot on stiff, frictionless
/// cables, ideal cameras.
namespace capstan::simulation {

/// One joint, its cable and the capstans at both of its ends.
struct ToolJointTruth {
  double radius_share = 0.0;     ///< by which r_l is larger than the nominal one
  double homing_error = 0.0;     ///< of the encoder's zero: added to q_hs [rad or m]
  double eccentricity = 0.0;     ///< of the motor's capstan [m]
  double eccentric_phase = 0.0;  ///< of its axis at the hard stop [rad]
  double stiffness = 1e8;        ///< of the cable pair [N/m]
  double play = 0.0;             ///< half-width, of cable travel [m]
  double coulomb = 0.0;          ///< friction at the joint [N·m or N]
  double stribeck_excess = 0.0;  ///< breakaway above Coulomb friction, as a share of it
  double stribeck_speed = 0.02;  ///< at which the excess has faded to 1/e [rad/s or m/s]
  double load_friction = 0.0;    ///< share of the cables' torque that turns into friction
  double viscous = 1e-3;         ///< [N·m·s or N·s/m]
  robot::DhRow geometry;         ///< added to the nominal row

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.radius_share, {"radius_share", "", "by which r_l is larger", {-0.5, 0.5}, false});
    field(self.homing_error, {"homing_error", "rad or m", "added to q_hs", {-1.0, 1.0}, false});
    field(self.eccentricity, {"eccentricity", "m", "of the motor's capstan", {0.0, 0.01}, false});
    field(self.eccentric_phase, {"eccentric_phase", "rad", "at the hard stop", {-6.3, 6.3}, false});
    field(self.stiffness, {"stiffness", "N/m", "of the cable pair", {1.0, 1e9}, false});
    field(self.play, {"play", "m", "half-width, of cable travel", {0.0, 0.01}, false});
    field(self.coulomb, {"coulomb", "N*m or N", "friction at the joint", {0.0, 100.0}, false});
    field(self.stribeck_excess, {"stribeck_excess", "", "breakaway above it, share", {0.0, 5.0}, false});
    field(self.stribeck_speed, {"stribeck_speed", "rad/s or m/s", "Stribeck's", {1e-4, 10.0}, false});
    field(self.load_friction, {"load_friction", "", "share of the cables' torque", {0.0, 0.5}, false});
    field(self.viscous, {"viscous", "N*m*s or N*s/m", "friction at the joint", {1e-6, 1e3}, false});
    field(self.geometry, {"geometry", "", "added to the Denavit-Hartenberg row", {}, false});
  }
};

/// PD control of motor angles, as ControllerTruth has it.
struct ToolControlTruth {
  double stiffness = 1.0;  ///< [N·m/rad]
  double damping = 0.027;  ///< [N·m·s/rad]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness,
          {"stiffness", "N*m/rad", "proportional gain on motor angles", {1e-3, 100.0}, false});
    field(self.damping, {"damping", "N*m*s/rad", "derivative gain on motor angles", {0.0, 1.0}, false});
  }
};

/// Motion capture of lights on the tool: what its poses have of errors.
struct PoseCameraTruth {
  double rate = 100.0;                                              ///< [1/s]
  double latency = 0.0;                                             ///< of the stamps behind the motion [s]
  double clock_jitter = 0.0;                                        ///< of the stamps, standard deviation [s]
  double position_sigma = 0.0;                                      ///< an axis [m]
  double rotation_sigma = 0.0;                                      ///< an axis [rad]
  Eigen::Vector3d registration_rotation = Eigen::Vector3d::Zero();  ///< of the base, rotation vector [rad]
  Eigen::Vector3d registration_shift = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d mounting_rotation = Eigen::Vector3d::Zero();      ///< of the lights on the tool [rad]
  double jump_rate = 0.0;      ///< how often a light hides and the rest is mistaken for another pose [1/s]
  double jump_time = 0.1;      ///< how long that lasts on average [s]
  double jump_size = 0.03;     ///< how far it jumps, an axis, standard deviation [m]
  double jump_rotation = 0.3;  ///< and rotations [rad]
  double miss_share = 0.0;     ///< of samples without any pose

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rate, {"rate", "1/s", "poses a second", {1.0, 1000.0}, false});
    field(self.latency, {"latency", "s", "of the stamps", {0.0, 0.5}, false});
    field(self.clock_jitter, {"clock_jitter", "s", "of the stamps", {0.0, 0.01}, false});
    field(self.position_sigma, {"position_sigma", "m", "noise, an axis", {0.0, 0.1}, false});
    field(self.rotation_sigma, {"turn_sigma", "rad", "noise, an axis", {0.0, 1.0}, false});
    field(self.registration_rotation,
          {"registration_turn", "rad", "error of the base's pose", {-0.5, 0.5}, false});
    field(self.registration_shift,
          {"registration_shift", "m", "error of the base's pose", {-0.2, 0.2}, false});
    field(self.mounting_rotation, {"mounting_turn", "rad", "of the lights on the tool", {-0.5, 0.5}, false});
    field(self.jump_rate, {"jump_rate", "1/s", "how often a light hides", {0.0, 10.0}, false});
    field(self.jump_time, {"jump_time", "s", "how long, on average", {0.01, 10.0}, false});
    field(self.jump_size, {"jump_size", "m", "how far the pose jumps, an axis", {0.0, 1.0}, false});
    field(self.jump_rotation, {"jump_turn", "rad", "how far it turns, an axis", {0.0, 3.0}, false});
    field(self.miss_share, {"miss_share", "", "samples without a pose", {0.0, 0.9}, false});
  }
};

using ToolMatrix = Eigen::Matrix<double, robot::kToolJoints, robot::kToolJoints>;

/// The whole truth file.
struct ToolTruth {
  std::string name = "matched";
  std::array<ToolJointTruth, robot::kToolJoints> joints;
  ToolMatrix coupling_error = ToolMatrix::Zero();  ///< added to A
  ToolControlTruth control;
  PoseCameraTruth camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what reports call this truth", {}, false});
    field(self.joints, {"joints", "", "joints 1 to 7", {}, false});
    field(self.coupling_error, {"coupling_error", "rad/rad or m/rad", "added to A", {-10.0, 10.0}, false});
    field(self.control, {"control", "", "of the motors", {}, false});
    field(self.camera, {"camera", "", "motion capture of the tool", {}, false});
  }
};

/// base::InputError naming file, line, key, value and range.
ToolTruth readToolTruth(const std::filesystem::path& path);

/// `nominal` with the truth's geometry, radii, zeros and coupling. base::InputError: not seven joints.
robot::Description trueRobot(const robot::Description& nominal, const ToolTruth& truth);

}  // namespace capstan::simulation
