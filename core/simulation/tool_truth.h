#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>

#include "core/base/field.h"
#include "core/robot/description.h"
#include "core/robot/tool_kinematics.h"

/// True parameters of a simulated seven-joint arm and of the cameras that observe its tool. The controller of
/// the arm assumes the nominal robot file instead. A default-constructed truth is the nominal robot with
/// stiff, frictionless cables and ideal cameras.
namespace capstan::simulation {

/// One joint, its cable and the capstans at both of its ends.
struct ToolJointTruth {
  double radius_share = 0.0;     ///< relative error of r_l: true / nominal − 1
  double homing_error = 0.0;     ///< error of the encoder's zero, added to q_hs [rad or m]
  double eccentricity = 0.0;     ///< eccentricity of the motor's capstan [m]
  double eccentric_phase = 0.0;  ///< phase of the eccentricity at the hard stop [rad]
  double stiffness = 1e8;        ///< stiffness of the cable pair [N/m]
  double play = 0.0;             ///< half-width of the backlash, in cable travel [m]
  double coulomb = 0.0;          ///< Coulomb friction at the joint [N·m or N]
  double stribeck_excess = 0.0;  ///< breakaway friction above Coulomb friction, as a share of it
  double stribeck_speed = 0.02;  ///< speed at which the excess has faded to 1/e [rad/s or m/s]
  double load_friction = 0.0;    ///< friction as a share of the cables' torque
  double viscous = 1e-3;         ///< viscous friction at the joint [N·m·s or N·s/m]
  robot::DhRow geometry;         ///< error of the Denavit–Hartenberg row, added to the nominal one

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.radius_share, {"radius_share", "", "relative error of r_l", {-0.5, 0.5}, false});
    field(self.homing_error, {"homing_error", "rad or m", "error of q_hs", {-1.0, 1.0}, false});
    field(self.eccentricity, {"eccentricity", "m", "motor capstan's eccentricity", {0.0, 0.01}, false});
    field(self.eccentric_phase, {"eccentric_phase", "rad", "phase at the hard stop", {-6.3, 6.3}, false});
    field(self.stiffness, {"stiffness", "N/m", "stiffness of the cable pair", {1.0, 1e9}, false});
    field(self.play, {"play", "m", "backlash half-width, cable travel", {0.0, 0.01}, false});
    field(self.coulomb, {"coulomb", "N*m or N", "Coulomb friction of the joint", {0.0, 100.0}, false});
    field(self.stribeck_excess, {"stribeck_excess", "", "breakaway above Coulomb", {0.0, 5.0}, false});
    field(self.stribeck_speed, {"stribeck_speed", "rad/s or m/s", "Stribeck speed", {1e-4, 10.0}, false});
    field(self.load_friction, {"load_friction", "", "friction by cable torque", {0.0, 0.5}, false});
    field(self.viscous, {"viscous", "N*m*s or N*s/m", "viscous friction", {1e-6, 1e3}, false});
    field(self.geometry, {"geometry", "", "error of the Denavit-Hartenberg row", {}, false});
  }
};

/// Gains of the PD control of motor angles; see ControllerTruth.
struct ToolControlTruth {
  double stiffness = 1.0;  ///< proportional gain [N·m/rad]
  double damping = 0.027;  ///< derivative gain [N·m·s/rad]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness,
          {"stiffness", "N*m/rad", "proportional gain on motor angles", {1e-3, 100.0}, false});
    field(self.damping, {"damping", "N*m*s/rad", "derivative gain on motor angles", {0.0, 1.0}, false});
  }
};

/// Errors of motion capture of the lights on a tool.
struct PoseCameraTruth {
  double rate = 100.0;          ///< pose rate [1/s]
  double latency = 0.0;         ///< delay of the time stamps behind the motion [s]
  double clock_jitter = 0.0;    ///< standard deviation of the time stamps [s]
  double position_sigma = 0.0;  ///< position noise per axis, standard deviation [m]
  double rotation_sigma = 0.0;  ///< rotation noise per axis, standard deviation [rad]
  Eigen::Vector3d registration_rotation = Eigen::Vector3d::Zero();  ///< rotation error of the base [rad]
  Eigen::Vector3d registration_shift = Eigen::Vector3d::Zero();     ///< position error of the base's pose [m]
  Eigen::Vector3d mounting_rotation = Eigen::Vector3d::Zero();  ///< rotation of the lights on the tool [rad]
  double jump_rate = 0.0;      ///< rate of jumps: a light is hidden and a wrong pose is observed [1/s]
  double jump_time = 0.1;      ///< mean duration of a jump [s]
  double jump_size = 0.03;     ///< position error of a jump per axis, standard deviation [m]
  double jump_rotation = 0.3;  ///< rotation error of a jump per axis, standard deviation [rad]
  double miss_share = 0.0;     ///< share of samples without a pose

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rate, {"rate", "1/s", "poses per second", {1.0, 1000.0}, false});
    field(self.latency, {"latency", "s", "delay of the time stamps", {0.0, 0.5}, false});
    field(self.clock_jitter, {"clock_jitter", "s", "noise of the time stamps", {0.0, 0.01}, false});
    field(self.position_sigma, {"position_sigma", "m", "noise per axis", {0.0, 0.1}, false});
    field(self.rotation_sigma, {"turn_sigma", "rad", "noise per axis", {0.0, 1.0}, false});
    field(self.registration_rotation,
          {"registration_turn", "rad", "rotation error of the base's pose", {-0.5, 0.5}, false});
    field(self.registration_shift,
          {"registration_shift", "m", "position error of the base's pose", {-0.2, 0.2}, false});
    field(self.mounting_rotation,
          {"mounting_turn", "rad", "rotation of the lights on the tool", {-0.5, 0.5}, false});
    field(self.jump_rate, {"jump_rate", "1/s", "rate of jumps of the pose", {0.0, 10.0}, false});
    field(self.jump_time, {"jump_time", "s", "mean duration of a jump", {0.01, 10.0}, false});
    field(self.jump_size, {"jump_size", "m", "position jump per axis, sigma", {0.0, 1.0}, false});
    field(self.jump_rotation, {"jump_turn", "rad", "rotation jump per axis, sigma", {0.0, 3.0}, false});
    field(self.miss_share, {"miss_share", "", "share of samples without a pose", {0.0, 0.9}, false});
  }
};

using ToolMatrix = Eigen::Matrix<double, robot::kToolJoints, robot::kToolJoints>;

/// Contents of a truth file.
struct ToolTruth {
  std::string name = "matched";
  std::array<ToolJointTruth, robot::kToolJoints> joints;
  ToolMatrix coupling_error = ToolMatrix::Zero();  ///< error of the coupling matrix A, added to it
  ToolControlTruth control;
  PoseCameraTruth camera;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "name of this truth in reports", {}, false});
    field(self.joints, {"joints", "", "joints 1 to 7", {}, false});
    field(self.coupling_error, {"coupling_error", "rad/rad or m/rad", "error of A", {-10.0, 10.0}, false});
    field(self.control, {"control", "", "motor control", {}, false});
    field(self.camera, {"camera", "", "motion capture of the tool", {}, false});
  }
};

/// Reads a truth file. Throws base::InputError with file, line, key, value and range.
ToolTruth readToolTruth(const std::filesystem::path& path);

/// `nominal` with geometry, radii, zeros and coupling of `truth`. Throws base::InputError unless the robot
/// has seven joints.
robot::Description trueRobot(const robot::Description& nominal, const ToolTruth& truth);

}  // namespace capstan::simulation
