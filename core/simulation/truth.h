#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/field.h"

/// What the simulated robot and its cameras really are, as against the nominal robot file that estimators
/// know. A default-constructed Truth is the matched one: the nominal robot, ideal sensors, ideal cameras. A
/// truth file lists what differs; every key is optional.
namespace capstan::simulation {

/// Bouc–Wen hysteresis of a cable, in parallel with its elastic force. The force is stiffness · z, where
///   dz/dt = d(delta)/dt · (1 − |z / yield|^exponent · (shape · sgn(z · d(delta)/dt) + 1 − shape)),
/// so that |z| <= yield. Wen, J. Eng. Mech. 102 (1976), with z in metres of cable stretch.
struct Hysteresis {
  double stiffness = 0.0;  ///< of the hysteretic branch [N/m]; 0: none
  double yield = 1e-4;     ///< saturation of z [m]
  double exponent = 1.0;   ///< sharpness of the transition
  double shape = 0.5;      ///< share beta of loading-dependent slip

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness, {"stiffness", "N/m", "of the hysteretic branch; 0: none", {0.0, 1e7}, false});
    field(self.yield, {"yield", "m", "stretch at which the branch slips", {1e-7, 0.1}, false});
    field(self.exponent, {"exponent", "", "sharpness of the transition to slip", {1.0, 10.0}, false});
    field(self.shape,
          {"shape", "", "share of slip that depends on the loading direction", {0.5, 1.0}, false});
  }
};

/// Stribeck friction of a joint: F_cl (1 + excess · exp(−(v / speed)²)) tanh(v / v_eps) + F_vl v.
struct Stribeck {
  double excess = 0.0;  ///< breakaway friction above Coulomb, as a share of it
  double speed = 0.02;  ///< Stribeck speed [rad/s or m/s]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.excess,
          {"excess", "", "breakaway above Coulomb friction, share of it; 0: none", {0.0, 5.0}, false});
    field(self.speed,
          {"speed", "rad/s or m/s", "speed at which the excess has faded to 1/e", {1e-4, 10.0}, false});
  }
};

/// One joint, its cable and its motor.
struct JointTruth {
  std::optional<double> link_radius;  ///< effective r_l [m/rad or m/m]; absent: nominal
  double stiffness_factor = 1.0;      ///< of k_e
  double damping_factor = 1.0;        ///< of b_e
  Hysteresis hysteresis;
  Stribeck stribeck;
  double torque_limit_factor = 1.0;  ///< of the motor torque limit

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.link_radius,
          {"link_radius", "m/rad or m/m", "effective r_l; absent: nominal", {1e-4, 10.0}, false});
    field(self.stiffness_factor,
          {"stiffness_factor", "", "cable stiffness by nominal", {0.005, 10.0}, false});
    field(self.damping_factor, {"damping_factor", "", "cable damping by nominal", {0.05, 10.0}, false});
    field(self.hysteresis, {"hysteresis", "", "Bouc-Wen hysteresis of the cable", {}, false});
    field(self.stribeck, {"stribeck", "", "Stribeck friction of the joint", {}, false});
    field(self.torque_limit_factor,
          {"torque_limit_factor", "", "torque limit by nominal", {0.0, 10.0}, false});
  }
};

/// Motor and joint encoders. The controller and MotorSample see the quantised motor angle; its velocity is
/// the difference quotient of the counts through a first-order low pass.
struct EncoderTruth {
  bool motor_quantised = false;   ///< to the robot file's counts a revolution
  double velocity_cutoff = 80.0;  ///< of the low pass [Hz]
  Eigen::Vector3d joint_resolution =
      Eigen::Vector3d::Zero();  ///< step of the reference [rad, rad, m]; 0: exact

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.motor_quantised, {"motor_quantised", "", "round motor angles to encoder counts", {}, false});
    field(self.velocity_cutoff,
          {"velocity_cutoff", "Hz", "low pass of the motor velocity", {1.0, 500.0}, false});
    field(self.joint_resolution,
          {"joint_resolution", "rad, rad, m", "reference step; 0: exact", {0.0, 0.1}, false});
  }
};

/// PD control of the motor angles at 1 kHz: tau = stiffness (q_md − q_m) + damping (dq_md − dq_m)
/// + friction_feedforward · tau_cm tanh(dq_md / v_eps). The RAVEN-II runs plain PD: no feed-forward by
/// default.
struct ControllerTruth {
  double stiffness = 1.0;             ///< [N·m/rad]
  double damping = 0.027;             ///< [N·m·s/rad]
  double friction_feedforward = 0.0;  ///< share of the nominal motor Coulomb friction

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.stiffness, {"stiffness", "N*m/rad", "proportional gain on motor angles", {0.0, 100.0}, false});
    field(self.damping, {"damping", "N*m*s/rad", "derivative gain on motor angles", {0.0, 1.0}, false});
    field(self.friction_feedforward,
          {"friction_feedforward", "", "share of tau_cm fed forward", {0.0, 1.5}, false});
  }
};

/// Cameras in time and place.
struct CameraTruth {
  double rate = 15.0;           ///< [frames/s]
  double exposure = 0.0;        ///< shutter time [s]; motion blurs over it
  double latency = 0.0;         ///< arrival after mid exposure [s]
  double latency_jitter = 0.0;  ///< standard deviation [s], cut at 3
  double clock_jitter = 0.0;    ///< standard deviation of the stamp [s], cut at 3
  double stamp_delay = 0.0;     ///< the stamp is late by this, unknown to anyone [s]
  Eigen::Vector3d rotation_error = Eigen::Vector3d::Zero();  ///< true mounting = nominal · exp(error) [rad]
  double pixel_sigma = 0.0;  ///< noise of a marker's position where no images are rendered [px]

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.rate, {"rate", "1/s", "frames a second", {1.0, 120.0}, false});
    field(self.exposure, {"exposure", "s", "shutter time", {0.0, 0.05}, false});
    field(self.latency, {"latency", "s", "arrival after mid exposure", {0.0, 1.0}, false});
    field(self.latency_jitter,
          {"latency_jitter", "s", "standard deviation of the latency", {0.0, 0.2}, false});
    field(self.clock_jitter,
          {"clock_jitter", "s", "standard deviation of the time stamp", {0.0, 0.05}, false});
    field(self.stamp_delay, {"stamp_delay", "s", "constant error of the time stamp", {-0.2, 0.2}, false});
    field(self.rotation_error,
          {"rotation_error", "rad", "rotation vector, nominal to true mounting", {-0.3, 0.3}, false});
    field(self.pixel_sigma,
          {"pixel_sigma", "px", "marker noise where no images are made", {0.0, 10.0}, false});
  }
};

/// What the cameras see. Zero everywhere: a clean, evenly lit scene.
struct ImageTruth {
  double noise = 0.0;           ///< standard deviation of each colour [grey levels]
  double exposure_noise = 0.0;  ///< standard deviation of a frame's brightness, as a share
  double unevenness = 0.0;      ///< 0: even light … 1: the dark side receives none
  double texture = 0.0;         ///< contrast of the background, 0…1
  int distractors = 0;          ///< still objects of nearly the marker's colour
  double distractor_hue = 8.0;  ///< their hue differs by this (OpenCV, 0…179)
  double marker_hue = 65.0;     ///< (OpenCV, 0…179)

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.noise, {"noise", "grey levels", "standard deviation of each colour", {0.0, 40.0}, false});
    field(self.exposure_noise,
          {"exposure_noise", "", "brightness change from frame to frame", {0.0, 0.2}, false});
    field(self.unevenness, {"unevenness", "", "0: even light, 1: one side dark", {0.0, 1.0}, false});
    field(self.texture, {"texture", "", "contrast of the background", {0.0, 1.0}, false});
    field(self.distractors, {"distractors", "", "objects of nearly the marker's colour", {0, 50}, false});
    field(self.distractor_hue, {"distractor_hue", "", "their hue minus the marker's", {-90.0, 90.0}, false});
    field(self.marker_hue, {"marker_hue", "", "hue of the marker (OpenCV, 0-179)", {0.0, 179.0}, false});
  }
};

/// The whole truth file.
struct Truth {
  std::string name = "matched";
  std::array<JointTruth, 3> joints;
  EncoderTruth encoders;
  ControllerTruth controller;
  CameraTruth cameras;
  ImageTruth images;
  int substeps = 10;  ///< integration steps of the plant a millisecond

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.name, {"name", "", "what reports call this truth", {}, false});
    field(self.joints, {"joints", "", "joints 1, 2, 3", {}, false});
    field(self.encoders, {"encoders", "", "motor and joint encoders", {}, false});
    field(self.controller, {"controller", "", "motor control at 1 kHz", {}, false});
    field(self.cameras, {"cameras", "", "timing and mounting", {}, false});
    field(self.images, {"images", "", "what the cameras see", {}, false});
    field(self.substeps, {"substeps", "", "integration steps a millisecond", {6, 1000}, false});
  }
};

/// The truth of resources/truth/default.yaml: 59 mm effective pulley on joint 1, worn cables, hysteresis,
/// Stribeck friction, real encoders, late and noisy cameras, a small mounting error.
Truth defaultTruth();
/// The truth of resources/truth/matched.yaml: the nominal robot with real encoders and camera noise, but no
/// fault.
Truth matchedTruth();
/// Throws base::InputError naming file, line, key, value and range.
Truth readTruth(const std::filesystem::path& path);
Truth parseTruth(const std::string& text, const std::string& name);
std::string formatTruth(const Truth& truth);

}  // namespace capstan::simulation
