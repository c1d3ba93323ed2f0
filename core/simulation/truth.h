#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/field.h"

/// True parameters of the simulated robot and its cameras. Estimators know the nominal robot file instead. A
/// default-constructed Truth is the nominal robot with ideal sensors and ideal cameras. A truth file lists
/// the differences from it; every key is optional.
namespace capstan::simulation {

/// Bouc–Wen hysteresis of a cable, in parallel with its elastic force. The force is stiffness · z, where
///   dz/dt = d(delta)/dt · (1 − |z / yield|^exponent · (shape · sgn(z · d(delta)/dt) + 1 − shape)),
/// so that |z| <= yield. Wen, J. Eng. Mech. 102 (1976), with z in metres of cable stretch.
struct Hysteresis {
  double stiffness = 0.0;  ///< stiffness of the hysteretic branch [N/m]; 0: no hysteresis
  double yield = 1e-4;     ///< saturation of z [m]
  double exponent = 1.0;   ///< sharpness of the transition to slip
  double shape = 0.5;      ///< share beta of slip that depends on the loading direction

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness, {"stiffness", "N/m", "hysteretic branch's stiffness; 0: none", {0.0, 1e7}, false});
    field(self.yield, {"yield", "m", "stretch at which the branch slips", {1e-7, 0.1}, false});
    field(self.exponent, {"exponent", "", "sharpness of the transition to slip", {1.0, 10.0}, false});
    field(self.shape,
          {"shape", "", "share of slip that depends on the loading direction", {0.5, 1.0}, false});
  }
};

/// Stribeck friction of a joint: F_cl (1 + excess · exp(−(v / speed)²)) tanh(v / v_eps) + F_vl v.
struct Stribeck {
  double excess = 0.0;  ///< breakaway friction above Coulomb friction, as a share of it
  double speed = 0.02;  ///< Stribeck speed [rad/s or m/s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.excess,
          {"excess", "", "breakaway above Coulomb friction, share of it; 0: none", {0.0, 5.0}, false});
    field(self.speed,
          {"speed", "rad/s or m/s", "speed at which the excess has faded to 1/e", {1e-4, 10.0}, false});
  }
};

/// True parameters of one joint, its cable and its motor. Factors are true value / nominal value.
struct JointTruth {
  std::optional<double> link_radius;  ///< effective r_l [m/rad or m/m]; absent: nominal
  double stiffness_factor = 1.0;      ///< factor of k_e
  double damping_factor = 1.0;        ///< factor of b_e
  Hysteresis hysteresis;
  Stribeck stribeck;
  double torque_limit_factor = 1.0;  ///< factor of the motor torque limit

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.link_radius,
          {"link_radius", "m/rad or m/m", "effective r_l; absent: nominal", {1e-4, 10.0}, false});
    field(self.stiffness_factor, {"stiffness_factor", "", "cable stiffness / nominal", {0.005, 10.0}, false});
    field(self.damping_factor, {"damping_factor", "", "cable damping / nominal", {0.05, 10.0}, false});
    field(self.hysteresis, {"hysteresis", "", "Bouc-Wen hysteresis of the cable", {}, false});
    field(self.stribeck, {"stribeck", "", "Stribeck friction of the joint", {}, false});
    field(self.torque_limit_factor,
          {"torque_limit_factor", "", "torque limit / nominal", {0.0, 10.0}, false});
  }
};

/// Motor and joint encoders. Controller and MotorSample get the quantised motor angle and its velocity: the
/// difference quotient of the counts after a first-order low pass.
struct EncoderTruth {
  bool motor_quantised = false;   ///< motor angles in the robot file's counts per revolution
  double velocity_cutoff = 80.0;  ///< cut-off frequency of the low pass [Hz]
  Eigen::Vector3d joint_resolution =
      Eigen::Vector3d::Zero();  ///< resolution of the joint encoders [rad, rad, m]; 0: exact

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.motor_quantised, {"motor_quantised", "", "round motor angles to encoder counts", {}, false});
    field(self.velocity_cutoff,
          {"velocity_cutoff", "Hz", "low pass of the motor velocity", {1.0, 500.0}, false});
    field(self.joint_resolution,
          {"joint_resolution", "rad, rad, m", "joint encoder step; 0: exact", {0.0, 0.1}, false});
  }
};

/// PD control of the motor angles at 1 kHz: tau = stiffness (q_md − q_m) + damping (dq_md − dq_m)
/// + friction_feedforward · tau_cm tanh(dq_md / v_eps). By default there is no feed-forward: the RAVEN-II
/// uses plain PD control.
struct ControllerTruth {
  double stiffness = 1.0;             ///< proportional gain [N·m/rad]
  double damping = 0.027;             ///< derivative gain [N·m·s/rad]
  double friction_feedforward = 0.0;  ///< share of the nominal motor Coulomb friction that is fed forward

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness, {"stiffness", "N*m/rad", "proportional gain on motor angles", {0.0, 100.0}, false});
    field(self.damping, {"damping", "N*m*s/rad", "derivative gain on motor angles", {0.0, 1.0}, false});
    field(self.friction_feedforward,
          {"friction_feedforward", "", "share of tau_cm fed forward", {0.0, 1.5}, false});
  }
};

/// Timing, mounting and pixel noise of the cameras.
struct CameraTruth {
  double rate = 15.0;           ///< frame rate [frames/s]
  double exposure = 0.0;        ///< shutter time [s], over which motion blurs
  double latency = 0.0;         ///< time from mid exposure to arrival [s]
  double latency_jitter = 0.0;  ///< standard deviation of the latency [s]; draws are cut at 3 σ
  double clock_jitter = 0.0;    ///< standard deviation of the time stamp [s]; draws are cut at 3 σ
  double stamp_delay = 0.0;     ///< constant delay of the time stamp [s], unknown to estimators
  Eigen::Vector3d rotation_error = Eigen::Vector3d::Zero();  ///< true mounting = nominal · exp(error) [rad]
  double pixel_sigma = 0.0;  ///< noise of a marker's position where no images are rendered [px]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rate, {"rate", "1/s", "frames per second", {1.0, 120.0}, false});
    field(self.exposure, {"exposure", "s", "shutter time", {0.0, 0.05}, false});
    field(self.latency, {"latency", "s", "time from mid exposure to arrival", {0.0, 1.0}, false});
    field(self.latency_jitter,
          {"latency_jitter", "s", "standard deviation of the latency", {0.0, 0.2}, false});
    field(self.clock_jitter,
          {"clock_jitter", "s", "standard deviation of the time stamp", {0.0, 0.05}, false});
    field(self.stamp_delay, {"stamp_delay", "s", "constant error of the time stamp", {-0.2, 0.2}, false});
    field(self.rotation_error,
          {"rotation_error", "rad", "rotation vector, nominal to true mounting", {-0.3, 0.3}, false});
    field(self.pixel_sigma,
          {"pixel_sigma", "px", "marker noise where no images are rendered", {0.0, 10.0}, false});
  }
};

/// Appearance of the scene in the images. All zero: a clean, evenly lit scene.
struct ImageTruth {
  double noise = 0.0;           ///< standard deviation of each colour [grey levels]
  double exposure_noise = 0.0;  ///< standard deviation of a frame's brightness, as a share
  double unevenness = 0.0;      ///< unevenness of the light, from 0 (even) to 1 (one side dark)
  double texture = 0.0;         ///< contrast of the background, 0…1
  int distractors = 0;          ///< number of static objects of nearly the marker's colour
  double distractor_hue = 8.0;  ///< hue of the distractors minus hue of the marker (OpenCV, 0…179)
  double marker_hue = 65.0;     ///< hue of the marker (OpenCV, 0…179)

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.noise, {"noise", "grey levels", "standard deviation of each colour", {0.0, 40.0}, false});
    field(self.exposure_noise,
          {"exposure_noise", "", "brightness change from frame to frame", {0.0, 0.2}, false});
    field(self.unevenness, {"unevenness", "", "0: even light, 1: one side dark", {0.0, 1.0}, false});
    field(self.texture, {"texture", "", "contrast of the background", {0.0, 1.0}, false});
    field(self.distractors, {"distractors", "", "objects of nearly the marker's colour", {0, 50}, false});
    field(self.distractor_hue, {"distractor_hue", "", "distractor hue - marker hue", {-90.0, 90.0}, false});
    field(self.marker_hue, {"marker_hue", "", "hue of the marker (OpenCV, 0-179)", {0.0, 179.0}, false});
  }
};

/// Contents of a truth file.
struct Truth {
  std::string name = "matched";
  std::array<JointTruth, 3> joints;
  EncoderTruth encoders;
  ControllerTruth controller;
  CameraTruth cameras;
  ImageTruth images;
  int substeps = 10;  ///< integration steps of the plant per millisecond

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "name of this truth in reports", {}, false});
    field(self.joints, {"joints", "", "joints 1, 2, 3", {}, false});
    field(self.encoders, {"encoders", "", "motor and joint encoders", {}, false});
    field(self.controller, {"controller", "", "motor control at 1 kHz", {}, false});
    field(self.cameras, {"cameras", "", "timing and mounting", {}, false});
    field(self.images, {"images", "", "appearance of the scene", {}, false});
    field(self.substeps, {"substeps", "", "integration steps per millisecond", {6, 1000}, false});
  }
};

/// Truth of resources/truth/default.yaml: an effective pulley radius of 59 mm on joint 1, worn cables,
/// hysteresis, Stribeck friction, real encoders, late and noisy cameras, a small mounting error.
Truth defaultTruth();
/// Truth of resources/truth/matched.yaml: the nominal robot with real encoders and camera noise, but without
/// faults.
Truth matchedTruth();
/// Reads a truth file or text. Throws base::InputError with file, line, key, value and range.
Truth readTruth(const std::filesystem::path& path);
Truth parseTruth(const std::string& text, const std::string& name);
std::string formatTruth(const Truth& truth);

}  // namespace capstan::simulation
