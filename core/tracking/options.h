#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "core/base/names.h"
#include "core/base/yaml.h"

namespace capstan::tracking {

/// Where the noise of q_cam comes from (CameraNoise): its sources, or a constant, as in the UKF paper.
enum class CameraNoiseKind { kPixels, kConstant };

/// The states that are estimated: those of the joints and of the transmission's slow error
/// (TransmissionEstimator), or those of the joints alone, as in the UKF paper.
enum class FilterKind { kAugmented, kSixState };

/// Every number of the tracking pipeline that is neither the robot's nor the camera's. Joint vectors are in
/// rad, rad, m (or per second where said). resources/tracking/default.yaml holds the same values.
struct TrackingOptions {
  FilterKind filter = FilterKind::kAugmented;
  Eigen::Vector3d position_noise{1e-2, 1e-2, 1e-3};  ///< density of process noise on q [rad/√s, rad/√s, m/√s]
  Eigen::Vector3d velocity_noise{0.5, 0.5, 0.05};  ///< density on dq [rad/s/√s, rad/s/√s, m/s/√s]
  Eigen::Vector3d initial_position_sigma{0.05, 0.05, 0.005};
  Eigen::Vector3d initial_velocity_sigma{0.1, 0.1, 0.02};
  Eigen::Vector3d kinematic_sigma{0.02, 0.01, 0.001};  ///< of q_kin where it stands in for the camera
  CameraNoiseKind camera_noise = CameraNoiseKind::kPixels;
  double registration_rotation_sigma = 0.01;  ///< mounting of the cameras about each axis [rad]
  double registration_shift_sigma = 1e-3;     ///< their place along each axis: sag at the hard stop [m]
  double camera_clock_sigma = 1e-3;           ///< of a stamp [s]
  int pixel_noise_memory = 300;               ///< frames that measure the pixels' noise; 0: as detected
  Eigen::Vector3d camera_sigma_floor{5e-4, 5e-4, 5e-5};     ///< noise floor, added (in square)
  Eigen::Vector3d constant_camera_sigma{1e-2, 1e-2, 5e-4};  ///< of q_cam with camera_noise: constant
  Eigen::Vector3d tip_sigma{2e-3, 2e-3, 2e-3};              ///< of a TipSample, along the axes of frame 0 [m]
  double epipolar_limit = 3.0;                 ///< farther off, the two pictures show different things [px]
  double gate_probability = 0.999;             ///< of the χ² gate on the innovation
  int jump_samples = 3;                        ///< consistent samples that end a jump
  Eigen::Vector3d jump_drift{0.1, 0.1, 0.01};  ///< fastest drift of q_cam − q_kin [rad/s, rad/s, m/s]
  Eigen::Vector3d jump_tolerance{0.15, 0.15, 0.02};  ///< largest plausible q_cam − q_kin [rad, rad, m]
  double camera_period = 1.0 / 15.0;                 ///< [s]
  double missing_after = 2.0;                        ///< camera periods without a sample: q_kin takes over
  double memory = 0.25;                              ///< how late a camera sample may come [s]
  bool roi_search = true;              ///< around the kinematic tip; false: always the whole frame
  bool full_frame_search = true;       ///< where the region of interest held no marker
  double differentiation_time = 4e-3;  ///< window of the difference for a missing dq_m [s]
  double camera_delay = 0.0;           ///< stamps of camera samples are later than their exposure by this [s]
  bool detect_frozen = true;           ///< encoders whose count stands still while the camera sees movement
  Eigen::Vector3d frozen_tolerance{0.02, 0.03, 0.002};  ///< movement that a still motor's cable allows
  double lost_after = 0.1;                              ///< motor numbers missing this long: failed [s]
  /// Of a joint whose motor is unknown (UnknownMotion): standard deviation of its speed and how long it
  /// lasts. Block transfers at the speed of the UKF paper have an RMS of half this, moves and rests taken
  /// together.
  Eigen::Vector3d unknown_speed{0.3, 0.5, 0.05};
  double unknown_speed_time = 0.2;  ///< [s]
  double restart_gap = 0.5;         ///< motor silence after which the filter restarts [s]
  int nis_window = 150;             ///< camera updates in the running mean of NIS
  /// Of the augmented filter (TransmissionEstimator), chosen on simulated sessions of seeds 11 to 14 and on
  /// recordings of another simulator. Standard deviation of a transmission error where there is one, and the
  /// prior probability that there is one, per joint.
  /// Of cable travel, relative: a pulley's radius; insertion has no pulley but the motor's own.
  Eigen::Vector3d scale_sigma{0.05, 0.05, 0.01};
  double offset_sigma = 2e-3;  ///< of a cable's zero [m]
  double scale_probability = 0.15;
  double offset_probability =
      0.01;  ///< an offset is hard to distinguish from cameras that are rotated about the base
  double compliance_sigma = 0.7;  ///< of 1 − k_e / k_e,true, where the robot file's stiffness is wrong
  double compliance_probability = 0.03;
  double change_log_odds = 12.0;  ///< against a change (cameras knocked, encoder slipped) in a given second
  double transmission_memory = 120.0;  ///< how long an observation of the transmission error counts [s]
  /// What cables of a robot that is not identified leave unexplained, and for how long it has one sign.
  Eigen::Vector3d cable_error{6e-4, 4e-3, 2e-4};
  double cable_error_time = 1.0;             ///< [s]
  double camera_delay_sigma = 0.03;          ///< of the camera's stamps, beyond camera_delay [s]
  double camera_moved_probability = 0.05;    ///< that cameras were moved since their registration
  double camera_moved_rotation_sigma = 0.1;  ///< by how much, about each axis [rad]
  double camera_moved_shift_sigma = 0.03;    ///< and along each axis [m]
  /// Of the cameras' scale, relative: what a calibration leaves in focal length and base line, and of cameras
  /// whose calibration no longer holds.
  double camera_scale_sigma = 0.01, camera_moved_scale_sigma = 0.05;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(self.filter, {"filter",
                        "",
                        "augmented: with slow transmission errors; six_state: as in the UKF paper",
                        {},
                        false});
    field(self.position_noise, {"position_noise",
                                "rad/sqrt(s) or m/sqrt(s)",
                                "process noise on joint positions",
                                {0.0, 10.0},
                                false});
    field(self.velocity_noise, {"velocity_noise",
                                "rad/s/sqrt(s) or m/s/sqrt(s)",
                                "process noise on joint speeds",
                                {1e-9, 1e3},
                                false});
    field(self.initial_position_sigma,
          {"initial_position_sigma", "rad or m", "of the first state", {1e-9, 10.0}, false});
    field(self.initial_velocity_sigma,
          {"initial_velocity_sigma", "rad/s or m/s", "of the first state", {1e-9, 100.0}, false});
    field(self.kinematic_sigma, {"kinematic_sigma",
                                 "rad or m",
                                 "of transmission kinematics instead of the camera",
                                 {1e-6, 10.0},
                                 false});
    field(self.camera_noise,
          {"camera_noise", "", "pixels: from its sources; constant: as in the UKF paper", {}, false});
    field(self.registration_rotation_sigma, {"registration_rotation_sigma",
                                             "rad",
                                             "of the cameras' mounting about each axis",
                                             {0.0, 1.0},
                                             false});
    field(self.registration_shift_sigma,
          {"registration_shift_sigma", "m", "of the cameras' place along each axis", {0.0, 1.0}, false});
    field(self.camera_clock_sigma,
          {"camera_clock_sigma", "s", "of the camera's time stamps", {0.0, 0.1}, false});
    field(self.pixel_noise_memory,
          {"pixel_noise_memory", "", "frames that measure pixel noise; 0: as detected", {0, 100000}, false});
    field(self.camera_sigma_floor, {"camera_sigma_floor",
                                    "rad or m",
                                    "camera error besides pixels, registration and clock",
                                    {0.0, 1.0},
                                    false});
    field(self.constant_camera_sigma, {"constant_camera_sigma",
                                       "rad or m",
                                       "camera error with camera_noise: constant",
                                       {1e-6, 10.0},
                                       false});
    field(self.tip_sigma,
          {"tip_sigma", "m", "of tip positions in recordings without images", {1e-6, 1.0}, false});
    field(self.epipolar_limit, {"epipolar_limit",
                                "px",
                                "largest distance of a marker from the other picture's epipolar line",
                                {0.1, 100.0},
                                false});
    field(self.gate_probability,
          {"gate_probability", "", "chi-square gate on the innovation", {0.5, 0.999999}, false});
    field(self.jump_samples, {"jump_samples", "", "consistent samples that end a jump", {1, 1000}, false});
    field(self.jump_drift,
          {"jump_drift", "rad/s or m/s", "fastest drift of camera against kinematics", {0.0, 10.0}, false});
    field(self.jump_tolerance,
          {"jump_tolerance", "rad or m", "largest believable camera against kinematics", {0.0, 10.0}, false});
    field(self.camera_period, {"camera_period", "s", "expected time between frames", {1e-3, 10.0}, false});
    field(
        self.missing_after,
        {"missing_after", "", "camera periods of silence until kinematics takes over", {1.0, 1000.0}, false});
    field(self.memory, {"memory", "s", "how late a camera sample may come", {0.0, 2.0}, false});
    field(self.roi_search,
          {"roi_search", "", "search around the kinematic tip; false: always the whole frame", {}, false});
    field(self.full_frame_search, {"full_frame_search",
                                   "",
                                   "search the whole frame when the region of interest held no marker",
                                   {},
                                   false});
    field(self.differentiation_time, {"differentiation_time",
                                      "s",
                                      "window of the difference for a missing motor velocity",
                                      {1e-4, 1.0},
                                      false});
    field(
        self.camera_delay,
        {"camera_delay", "s", "stamps of the camera minus exposure (identify finds it)", {-0.5, 0.5}, false});
    field(self.detect_frozen,
          {"detect_frozen", "", "find motor encoders that stand still while the joint moves", {}, false});
    field(self.frozen_tolerance, {"frozen_tolerance",
                                  "rad or m",
                                  "joint movement that cables allow while the motor stands still",
                                  {0.0, 1.0},
                                  false});
    field(self.lost_after,
          {"lost_after", "s", "motor position missing for this long: encoder failed", {0.0, 10.0}, false});
    field(self.unknown_speed, {"unknown_speed",
                               "rad/s or m/s",
                               "standard deviation of the speed of a joint whose motor encoder failed",
                               {1e-6, 10.0},
                               false});
    field(self.unknown_speed_time,
          {"unknown_speed_time", "s", "how long such a speed lasts", {0.01, 100.0}, false});
    field(self.restart_gap,
          {"restart_gap", "s", "motor silence after which the filter restarts", {1e-2, 100.0}, false});
    field(self.nis_window,
          {"nis_window", "", "camera updates in the running mean of NIS", {1, 100000}, false});
    field(self.scale_sigma,
          {"scale_sigma", "", "relative error of a pulley radius, where there is one", {1e-6, 1.0}, false});
    field(self.offset_sigma,
          {"offset_sigma", "m", "error of a cable's zero, where there is one", {1e-9, 1.0}, false});
    field(self.scale_probability,
          {"scale_probability", "", "prior probability of a wrong pulley radius", {1e-9, 0.999}, false});
    field(self.offset_probability,
          {"offset_probability", "", "prior probability of a wrong cable zero", {1e-9, 0.999}, false});
    field(self.compliance_sigma, {"compliance_sigma",
                                  "",
                                  "1 - nominal over true cable stiffness, where the stiffness is wrong",
                                  {1e-6, 100.0},
                                  false});
    field(
        self.compliance_probability,
        {"compliance_probability", "", "prior probability of a wrong cable stiffness", {1e-9, 0.999}, false});
    field(self.change_log_odds, {"change_log_odds",
                                 "",
                                 "log evidence from which on a change of cameras or encoders is accepted",
                                 {0.0, 1e6},
                                 false});
    field(self.transmission_memory, {"transmission_memory",
                                     "s",
                                     "how long an observation of the transmission error counts",
                                     {1.0, 1e6},
                                     false});
    field(self.cable_error, {"cable_error",
                             "rad or m",
                             "slow joint errors that the cable model does not explain",
                             {0.0, 1.0},
                             false});
    field(self.cable_error_time,
          {"cable_error_time", "s", "how long such an error keeps its sign", {1e-3, 1e3}, false});
    field(self.camera_delay_sigma,
          {"camera_delay_sigma", "s", "of the camera's stamps, beyond camera_delay", {1e-6, 1.0}, false});
    field(self.camera_moved_probability, {"camera_moved_probability",
                                          "",
                                          "prior probability that cameras moved since their registration",
                                          {1e-9, 0.999},
                                          false});
    field(self.camera_moved_rotation_sigma, {"camera_moved_rotation_sigma",
                                             "rad",
                                             "rotation of cameras that moved, about each axis",
                                             {1e-6, 3.0},
                                             false});
    field(self.camera_moved_shift_sigma, {"camera_moved_shift_sigma",
                                          "m",
                                          "shift of cameras that moved, along each axis",
                                          {1e-6, 1.0},
                                          false});
    field(self.camera_scale_sigma,
          {"camera_scale_sigma", "", "relative error of the cameras' scale", {1e-9, 1.0}, false});
    field(self.camera_moved_scale_sigma,
          {"camera_moved_scale_sigma", "", "the same of cameras that moved", {1e-9, 1.0}, false});
  }
};

/// The same options with the six-state filter of the UKF paper.
inline TrackingOptions sixState(TrackingOptions options = {}) {
  options.filter = FilterKind::kSixState;
  return options;
}

/// Reads filter options; absent fields keep their defaults. Throws base::InputError.
inline TrackingOptions readTrackingOptions(const std::filesystem::path& path) {
  return base::readYamlFile<TrackingOptions>(path);
}

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::CameraNoiseKind> {
  using K = capstan::tracking::CameraNoiseKind;
  static constexpr std::array value = {std::pair{K::kPixels, "pixels"}, std::pair{K::kConstant, "constant"}};
};
template <>
struct capstan::base::NamesOf<capstan::tracking::FilterKind> {
  using K = capstan::tracking::FilterKind;
  static constexpr std::array value = {std::pair{K::kAugmented, "augmented"},
                                       std::pair{K::kSixState, "six_state"}};
};
