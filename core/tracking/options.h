#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>

#include "core/base/names.h"
#include "core/base/yaml.h"

namespace capstan::tracking {

/// Model of the noise of q_cam: computed from its sources (CameraNoise), or constant as in the UKF paper.
enum class CameraNoiseKind { kPixels, kConstant };

/// Set of estimated states: joints and slow errors of the transmission (TransmissionEstimator), or joints
/// alone as in the UKF paper.
enum class FilterKind { kAugmented, kSixState };

/// What is observed while only one camera sees the marker: transmission kinematics (UKF paper, section V-D:
/// hard switch), or the ray of the other camera, which is a measurement of two numbers.
enum class OneCamera { kKinematics, kRay };

/// Settings of the tracking pipeline, except those of the robot and the cameras. Joint vectors are in rad,
/// rad, m; σ is a standard deviation. resources/tracking/default.yaml holds the same values.
struct TrackingOptions {
  FilterKind filter = FilterKind::kAugmented;
  Eigen::Vector3d position_noise{1e-2, 1e-2, 1e-3};  ///< density of process noise on q [rad/√s, rad/√s, m/√s]
  /// Density of process noise on dq [rad/s/√s, rad/s/√s, m/s/√s].
  Eigen::Vector3d velocity_noise{0.5, 0.5, 0.05};
  Eigen::Vector3d initial_position_sigma{0.05, 0.05, 0.005};
  Eigen::Vector3d initial_velocity_sigma{0.1, 0.1, 0.02};  ///< [rad/s, rad/s, m/s]
  Eigen::Vector3d kinematic_sigma{0.02, 0.01, 0.001};      ///< σ of q_kin when it replaces the camera
  CameraNoiseKind camera_noise = CameraNoiseKind::kPixels;
  OneCamera one_camera = OneCamera::kKinematics;
  double registration_rotation_sigma = 0.01;  ///< σ of the cameras' rotation about each axis [rad]
  double registration_shift_sigma = 1e-3;     ///< σ of the cameras' shift along each axis, from sag [m]
  double camera_clock_sigma = 1e-3;           ///< σ of a camera time stamp [s]
  int pixel_noise_memory = 300;               ///< frames from which pixel noise is measured; 0: as detected
  Eigen::Vector3d camera_sigma_floor{5e-4, 5e-4, 5e-5};     ///< σ of a noise floor that is added to q_cam
  Eigen::Vector3d constant_camera_sigma{1e-2, 1e-2, 5e-4};  ///< σ of q_cam with camera_noise: constant
  Eigen::Vector3d tip_sigma{2e-3, 2e-3, 2e-3};  ///< σ of a TipSample along the axes of frame 0 [m]
  double epipolar_limit = 3.0;                  ///< largest epipolar distance of two views of a marker [px]
  double gate_probability = 0.999;              ///< probability of the χ² gate on the innovation
  int jump_samples = 3;                         ///< number of consistent samples that end a jump
  Eigen::Vector3d jump_drift{0.1, 0.1, 0.01};   ///< fastest drift of q_cam − q_kin [rad/s, rad/s, m/s]
  Eigen::Vector3d jump_tolerance{0.15, 0.15, 0.02};  ///< largest plausible q_cam − q_kin [rad, rad, m]
  double camera_period = 1.0 / 15.0;                 ///< expected time between frames [s]
  double missing_after = 2.0;          ///< camera periods without a sample until q_kin replaces the camera
  double memory = 0.25;                ///< largest delay of a camera sample [s]
  bool roi_search = true;              ///< search around the kinematic tip; false: always the whole frame
  bool full_frame_search = true;       ///< search the whole frame if the region of interest holds no marker
  double differentiation_time = 4e-3;  ///< window of the difference for a missing dq_m [s]
  double camera_delay = 0.0;           ///< time stamp minus exposure time of a camera sample [s]
  bool detect_frozen = true;           ///< detect encoders that stand still while the camera sees movement
  Eigen::Vector3d frozen_tolerance{0.02, 0.03, 0.002};  ///< movement that the cable of a still motor allows
  double lost_after = 0.1;  ///< time without a motor position until the encoder counts as failed [s]
  /// σ of the speed of a joint whose motor is unknown (UnknownMotion) [rad/s, rad/s, m/s]: twice the RMS
  /// speed of block transfers in the UKF paper, moves and rests taken together.
  Eigen::Vector3d unknown_speed{0.3, 0.5, 0.05};
  double unknown_speed_time = 0.2;  ///< correlation time of that speed [s]
  double restart_gap = 0.5;         ///< motor silence after which the filter restarts [s]
  int nis_window = 150;             ///< camera updates in the running mean of NIS
  /// Settings of the augmented filter (TransmissionEstimator) from here on. Their values were chosen on
  /// simulated sessions of seeds 11 to 14 and on recordings of another simulator. *_sigma is σ of an error if
  /// the error exists; *_probability is the prior probability, per joint, that it exists.
  /// Relative error of cable travel (pulley radius); insertion has no pulley but the motor's own.
  Eigen::Vector3d scale_sigma{0.05, 0.05, 0.01};
  double offset_sigma = 2e-3;  ///< error of a cable's zero [m]
  double scale_probability = 0.3;
  /// Low, because an offset is hard to distinguish from cameras that are rotated about the base.
  double offset_probability = 0.01;
  double compliance_sigma = 0.7;  ///< 1 − k_e / k_e,true, where k_e is the robot file's stiffness
  double compliance_probability = 0.03;
  double change_log_odds = 12.0;       ///< log odds against a change of cameras or encoder in a given second
  double transmission_memory = 120.0;  ///< time constant of forgetting the transmission error [s]
  /// Slow joint errors that the cable model of a robot without identification does not explain.
  Eigen::Vector3d cable_error{6e-4, 4e-3, 2e-4};
  double cable_error_time = 1.0;             ///< time for which such an error keeps its sign [s]
  double camera_delay_sigma = 0.03;          ///< σ of the camera's delay beyond camera_delay [s]
  double camera_moved_probability = 0.05;    ///< probability that cameras moved since their registration
  double camera_moved_rotation_sigma = 0.1;  ///< σ of the rotation of such cameras about each axis [rad]
  double camera_moved_shift_sigma = 0.03;    ///< σ of the shift of such cameras along each axis [m]
  /// Relative σ of the cameras' scale (focal length and base line): of a valid calibration, and of a
  /// calibration that no longer holds.
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
          {"initial_position_sigma", "rad or m", "sigma of the first position", {1e-9, 10.0}, false});
    field(self.initial_velocity_sigma,
          {"initial_velocity_sigma", "rad/s or m/s", "sigma of the first speed", {1e-9, 100.0}, false});
    field(self.kinematic_sigma, {"kinematic_sigma",
                                 "rad or m",
                                 "sigma of transmission kinematics when it replaces the camera",
                                 {1e-6, 10.0},
                                 false});
    field(self.camera_noise,
          {"camera_noise", "", "pixels: from its sources; constant: as in the UKF paper", {}, false});
    field(self.one_camera,
          {"one_camera", "", "while one camera is blocked: kinematics, or ray of the other one", {}, false});
    field(self.registration_rotation_sigma, {"registration_rotation_sigma",
                                             "rad",
                                             "sigma of the cameras' rotation about each axis",
                                             {0.0, 1.0},
                                             false});
    field(self.registration_shift_sigma, {"registration_shift_sigma",
                                          "m",
                                          "sigma of the cameras' position along each axis",
                                          {0.0, 1.0},
                                          false});
    field(self.camera_clock_sigma,
          {"camera_clock_sigma", "s", "sigma of the camera's time stamps", {0.0, 0.1}, false});
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
          {"tip_sigma", "m", "sigma of tip positions in recordings without images", {1e-6, 1.0}, false});
    field(self.epipolar_limit, {"epipolar_limit",
                                "px",
                                "largest distance of a marker from the other image's epipolar line",
                                {0.1, 100.0},
                                false});
    field(self.gate_probability,
          {"gate_probability", "", "chi-square gate on the innovation", {0.5, 0.999999}, false});
    field(self.jump_samples, {"jump_samples", "", "consistent samples that end a jump", {1, 1000}, false});
    field(self.jump_drift,
          {"jump_drift", "rad/s or m/s", "fastest drift of camera minus kinematics", {0.0, 10.0}, false});
    field(self.jump_tolerance,
          {"jump_tolerance", "rad or m", "largest plausible camera minus kinematics", {0.0, 10.0}, false});
    field(self.camera_period, {"camera_period", "s", "expected time between frames", {1e-3, 10.0}, false});
    field(self.missing_after, {"missing_after",
                               "",
                               "camera periods of silence until kinematics replace the camera",
                               {1.0, 1000.0},
                               false});
    field(self.memory, {"memory", "s", "largest delay of a camera sample", {0.0, 2.0}, false});
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
          {"detect_frozen", "", "detect motor encoders that stand still while the joint moves", {}, false});
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
    field(self.unknown_speed_time, {"unknown_speed_time",
                                    "s",
                                    "correlation time of the speed of a joint whose motor encoder failed",
                                    {0.01, 100.0},
                                    false});
    field(self.restart_gap,
          {"restart_gap", "s", "motor silence after which the filter restarts", {1e-2, 100.0}, false});
    field(self.nis_window,
          {"nis_window", "", "camera updates in the running mean of NIS", {1, 100000}, false});
    field(self.scale_sigma,
          {"scale_sigma", "", "sigma of the relative error of a wrong pulley radius", {1e-6, 1.0}, false});
    field(self.offset_sigma,
          {"offset_sigma", "m", "sigma of the error of a wrong cable zero", {1e-9, 1.0}, false});
    field(self.scale_probability,
          {"scale_probability", "", "prior probability of a wrong pulley radius", {1e-9, 0.999}, false});
    field(self.offset_probability,
          {"offset_probability", "", "prior probability of a wrong cable zero", {1e-9, 0.999}, false});
    field(self.compliance_sigma,
          {"compliance_sigma",
           "",
           "sigma of 1 - nominal over true cable stiffness, where the stiffness is wrong",
           {1e-6, 100.0},
           false});
    field(
        self.compliance_probability,
        {"compliance_probability", "", "prior probability of a wrong cable stiffness", {1e-9, 0.999}, false});
    field(self.change_log_odds, {"change_log_odds",
                                 "",
                                 "log evidence that a change of cameras or encoders needs to be accepted",
                                 {0.0, 1e6},
                                 false});
    field(self.transmission_memory, {"transmission_memory",
                                     "s",
                                     "time constant of forgetting observations of the transmission error",
                                     {1.0, 1e6},
                                     false});
    field(self.cable_error, {"cable_error",
                             "rad or m",
                             "slow joint errors that the cable model does not explain",
                             {0.0, 1.0},
                             false});
    field(self.cable_error_time,
          {"cable_error_time", "s", "time for which a slow joint error keeps its sign", {1e-3, 1e3}, false});
    field(self.camera_delay_sigma,
          {"camera_delay_sigma", "s", "sigma of the camera's delay beyond camera_delay", {1e-6, 1.0}, false});
    field(self.camera_moved_probability, {"camera_moved_probability",
                                          "",
                                          "prior probability that cameras moved since their registration",
                                          {1e-9, 0.999},
                                          false});
    field(self.camera_moved_rotation_sigma, {"camera_moved_rotation_sigma",
                                             "rad",
                                             "sigma of the rotation of cameras that moved, about each axis",
                                             {1e-6, 3.0},
                                             false});
    field(self.camera_moved_shift_sigma, {"camera_moved_shift_sigma",
                                          "m",
                                          "sigma of the shift of cameras that moved, along each axis",
                                          {1e-6, 1.0},
                                          false});
    field(
        self.camera_scale_sigma,
        {"camera_scale_sigma", "", "sigma of the relative error of the cameras' scale", {1e-9, 1.0}, false});
    field(self.camera_moved_scale_sigma, {"camera_moved_scale_sigma",
                                          "",
                                          "sigma of the relative error of the scale of cameras that moved",
                                          {1e-9, 1.0},
                                          false});
  }
};

/// The same options with the six-state filter of the UKF paper.
inline TrackingOptions sixState(TrackingOptions options = {}) {
  options.filter = FilterKind::kSixState;
  return options;
}

/// Reads tracking options from YAML; absent fields keep their defaults. Throws base::InputError.
inline TrackingOptions readTrackingOptions(const std::filesystem::path& path) {
  return base::readYamlFile<TrackingOptions>(path);
}

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::OneCamera> {
  using O = capstan::tracking::OneCamera;
  static constexpr std::array value = {std::pair{O::kKinematics, "kinematics"}, std::pair{O::kRay, "ray"}};
};
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
