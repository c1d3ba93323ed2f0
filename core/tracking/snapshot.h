#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/base/names.h"
#include "core/base/units.h"
#include "core/tracking/transmission_estimate.h"
#include "core/vision/marker.h"

namespace capstan::tracking {

/// Reason why the filter observes transmission kinematics instead of the camera (UKF paper, section V-D);
/// kOpen: it observes the camera.
/// kExchanged: the left image is the right camera's, and the other way round. kLate: camera samples come, but
/// are older than the filter's memory.
enum class Gate {
  kOpen,
  kNoCamera,
  kLeftLost,
  kRightLost,
  kBothLost,
  kUnreachable,
  kJump,
  kUnregistered,
  kExchanged,
  kLate
};

/// Reason why a motor's encoder is not used; its joint is then estimated without it.
enum class MotorFault { kNone, kLost, kFrozen, kDeclared };

inline constexpr std::array<const char*, 3> kJointUnits = {"deg", "deg", "mm"};

/// `value` [rad, m] of a joint in kJointUnits.
constexpr double forPeople(double value, int joint) { return base::degreesOrMillimetres(value, joint != 2); }

/// State of the pipeline after one sample. Plain data; joints in rad, rad, m. Quantities that do not exist
/// (no reference encoders, no camera sample yet) are NaN.
struct Snapshot {
  double t = 0.0;                    ///< time of the newest motor sample [s]
  bool motor_updated = false;        ///< this step took a motor sample
  std::uint64_t motor_samples = 0;   ///< number of motor samples taken so far
  std::uint64_t motor_refused = 0;   ///< number of motor samples refused: not finite, or time not increasing
  std::uint64_t motor_stray = 0;     ///< number of motor samples with positions not used (StrayReadings)
  std::uint64_t camera_samples = 0;  ///< number of frames or tip samples taken so far

  /// Failed encoders, by motor: kLost gave no position for longer than a gap, kFrozen stands still while the
  /// camera sees the joint move, kDeclared was declared failed by the user.
  std::array<MotorFault, 3> motor_failed{};

  Eigen::Vector3d q_motor, dq_motor;  ///< q_m [rad], dq_m [rad/s]; the last known q_m of a lost encoder
  /// Joints of transmission kinematics; NaN for the joint of an unknown motor. The other joints are then
  /// computed with q_link_ukf in its place.
  Eigen::Vector3d q_link_kin;
  Eigen::Vector3d q_link_cam;        ///< newest camera observation, at its own time t_cam
  Eigen::Vector3d q_link_cam_sigma;  ///< its standard deviation
  Eigen::Vector3d q_link_ukf, dq_link_ukf;
  Eigen::Vector3d q_link_ukf_sigma;  ///< standard deviation of q_link_ukf
  Eigen::Vector3d q_link_true;       ///< newest reference
  Eigen::Vector3d q_link_true_cam;   ///< reference at t_cam, where it is known
  Eigen::Vector3d cable_stretch;     ///< delta = s_m − s_l at the estimate [m]; unknown motor: NaN
  Eigen::Vector3d cable_tension;     ///< gamma at the estimate [N]

  bool reference_paired = false;  ///< since this step q_link_true and the estimates are of one time
  /// q_link_true is the robot's own transmission kinematics: estimates differ from it, but that is no error.
  bool own_kinematics = false;

  double t_cam = 0.0;                             ///< exposure time of the newest camera sample
  double latency = 0.0;                           ///< arrival minus exposure of the newest camera sample [s]
  bool camera_updated = false;                    ///< this step took a camera sample
  bool camera_images = false;                     ///< the newest camera sample was a pair of images
  std::array<bool, 2> view_blocked{};             ///< StereoFrame::blocked of the newest pair of images
  std::array<vision::MarkerDetection, 2> marker;  ///< left, right
  Eigen::Vector3d tip_in_camera;                  ///< triangulated, left camera's frame [m]
  Eigen::Matrix3d tip_in_camera_covariance;       ///< [m²]
  /// Tip of transmission kinematics at t_cam, in frame 0 [m]; unknown motors are replaced by the estimate.
  Eigen::Vector3d tip_kin_cam;
  Eigen::Vector3d tip_cam, tip_kin, tip_ukf;  ///< in frame 0 [m]
  Eigen::Matrix3d tip_ukf_covariance;         ///< [m²]
  Gate gate = Gate::kNoCamera;
  /// The newest camera sample had the marker in one image only, and its ray was observed
  /// (TrackingOptions::one_camera).
  bool ray_used = false;
  double ray_nis = 0.0;  ///< NIS of that update: chi-square, 2 degrees of freedom

  TransmissionEstimate transmission;  ///< estimate of the augmented filter; else empty

  double nis = 0.0;  ///< NIS of the last update
  /// Innovation of the joints at the newest accepted camera sample, q_cam minus its prediction [rad, rad, m],
  /// and the standard deviation that the filter predicts for it; NaN where the sample was not accepted.
  Eigen::Vector3d innovation, innovation_sigma;
  double nis_mean = 0.0;       ///< mean NIS of the last camera updates, divided by its degrees of freedom
  bool nis_consistent = true;  ///< nis_mean inside the 95 % chi-square band
  double nees =
      0.0;  ///< NEES of the joint positions (3 degrees of freedom) if a true reference is known, else NaN
  std::uint64_t rescues = 0;       ///< number of Cholesky down-dates that used the fallback
  std::uint64_t late_dropped = 0;  ///< camera samples outside the filter's memory (usually too late)
};

/// True if an encoder has failed.
inline bool anyMotorFailed(const Snapshot& s) {
  for (const MotorFault fault : s.motor_failed)
    if (fault != MotorFault::kNone) return true;
  return false;
}

}  // namespace capstan::tracking

template <>
struct capstan::base::NamesOf<capstan::tracking::MotorFault> {
  using F = capstan::tracking::MotorFault;
  static constexpr std::array value = {std::pair{F::kNone, "none"}, std::pair{F::kLost, "lost"},
                                       std::pair{F::kFrozen, "frozen"}, std::pair{F::kDeclared, "declared"}};
};
template <>
struct capstan::base::NamesOf<capstan::tracking::Gate> {
  using G = capstan::tracking::Gate;
  static constexpr std::array value = {std::pair{G::kOpen, "camera"},
                                       std::pair{G::kNoCamera, "no camera"},
                                       std::pair{G::kLeftLost, "left lost"},
                                       std::pair{G::kRightLost, "right lost"},
                                       std::pair{G::kBothLost, "both lost"},
                                       std::pair{G::kUnreachable, "tip out of reach"},
                                       std::pair{G::kJump, "marker jumped"},
                                       std::pair{G::kUnregistered, "not registered"},
                                       std::pair{G::kExchanged, "left and right camera exchanged"},
                                       std::pair{G::kLate, "images too late"}};
};

namespace capstan::tracking {

/// True if the newest camera sample is a tip that another system measured, without images.
inline bool tipAlone(const Snapshot& s) { return s.camera_samples > 0 && !s.camera_images; }

/// True if the marker is hidden from a camera in the newest sample.
inline bool markerLost(const Snapshot& s) {
  return s.gate == Gate::kLeftLost || s.gate == Gate::kRightLost || s.gate == Gate::kBothLost;
}

/// Name of the gate's state, in words for images or for tips.
inline std::string_view gateWords(const Snapshot& s) {
  if (s.ray_used) return s.gate == Gate::kLeftLost ? "right camera alone" : "left camera alone";
  if (tipAlone(s)) {
    if (s.gate == Gate::kBothLost) return "tip not seen";
    if (s.gate == Gate::kNoCamera) return "no tips";
    if (s.gate == Gate::kJump) return "tip jumped";
    if (s.gate == Gate::kLate) return "tips too late";
  }
  if (markerLost(s))
    for (const auto& marker : s.marker)
      if (marker.fault == vision::MarkerFault::kWrongImage) return base::nameOf(marker.fault);
  return base::nameOf(s.gate);
}

/// True if the filter has no camera sample to use: none comes, or all are too late.
inline bool cameraSilent(const Snapshot& s) {
  return s.camera_samples > 0 && (s.gate == Gate::kNoCamera || s.gate == Gate::kLate);
}

}  // namespace capstan::tracking

template <>
struct capstan::base::KeysOf<capstan::tracking::Gate> {
  using G = capstan::tracking::Gate;
  static constexpr std::array value = {std::pair{G::kOpen, "camera"},
                                       std::pair{G::kNoCamera, "no_camera"},
                                       std::pair{G::kLeftLost, "left_lost"},
                                       std::pair{G::kRightLost, "right_lost"},
                                       std::pair{G::kBothLost, "both_lost"},
                                       std::pair{G::kUnreachable, "out_of_reach"},
                                       std::pair{G::kJump, "marker_jumped"},
                                       std::pair{G::kUnregistered, "not_registered"},
                                       std::pair{G::kExchanged, "cameras_exchanged"},
                                       std::pair{G::kLate, "too_late"}};
};
