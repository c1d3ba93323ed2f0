#pragma once

#include <array>
#include <vector>

#include "core/experiments/training_motions.h"
#include "core/learning/poses/next_observation.h"

/// Surgical debridement on a simulated arm (GPR paper, section V-D): each foam fragment is found, approached,
/// grasped and taken to a receptacle.
namespace capstan::experiments {

/// Method of moving the arm to a goal.
enum class DebridementMethod {
  kReplanning,      ///< slow, in short pieces with an observation and a new plan after each, as in prior work
  kCorrected,       ///< fast, without observations, with the learned correction
  kOpenLoop,        ///< fast, without observations, with the native controller alone
  kWhereUncertain,  ///< kCorrected while the confidence of the correction is high (next_observation.h), then
                    ///< kReplanning
};
inline constexpr std::size_t kDebridementMethods = 4;

struct DebridementTaskOptions {
  int fragments = 100;                               ///< number of fragments
  Eigen::Vector3d beside = Eigen::Vector3d::Zero();  ///< offset of the grid: lateral, depth, height [m]
  static constexpr double kSlow = 0.01;              ///< speed of kReplanning, the paper's prior work [m/s]
  static constexpr double kFast = 0.06;              ///< speed of the other methods, the paper's [m/s]
  static constexpr double kPiece = 0.02;             ///< length of a piece of kReplanning [m]
  double near = 0.002;                               ///< distance within which kReplanning has arrived [m]
  learning::CorrectionMode mode = learning::CorrectionMode::kEndPoint;  ///< mode of kCorrected
  int waypoints = 10;                              ///< number of waypoints per motion without observations
  static constexpr double kMostYaw = 0.35;         ///< largest yaw of a fragment [rad]
  static constexpr double kHover = 0.02;           ///< height above a fragment before and after grasping [m]
  static constexpr double kFindTime = 2.0;         ///< time to detect a fragment [s]
  static constexpr double kPlanTime = 0.5;         ///< time to plan a motion [s]
  static constexpr double kJawTime = 0.7;          ///< time to open or close the jaws [s]
  static constexpr double kSettle = 0.2;           ///< time at rest at the goal of a motion [s]
  static constexpr double kLook = 0.2;             ///< duration of an observation [s]
  static constexpr double kFindSigma = 5e-4;       ///< horizontal noise of the detected position [m]
  static constexpr double kFindDepthSigma = 1e-3;  ///< vertical noise of the detected position [m]
  static constexpr double kFindYawSigma = 0.05;    ///< noise of the detected yaw [rad]
  /// Largest distance between the point between the jaws and the fragment's centre in a successful grasp,
  /// across and along the jaws [m].
  double capture = 0.004;
  static constexpr double kCaptureRotation = 0.45;  ///< largest rotation error in a successful grasp [rad]
  static constexpr double kReceptacle = 0.02;       ///< radius of the receptacle [m]
  std::uint64_t seed = 1;
};

/// Throws base::InputError for options out of range.
void checkDebridementTask(const DebridementTaskOptions& options);

/// Result for one fragment.
struct FragmentRun {
  double time = 0.0;            ///< time from the start of detection to the drop [s]
  double moving = 0.0;          ///< part of `time` with the arm in motion [s]
  double off = 0.0;             ///< distance of jaws and fragment when the jaws closed [m]
  double rotation_error = 0.0;  ///< rotation error when the jaws closed [rad]
  bool grasped = false;
  bool cleared = false;  ///< grasped, and dropped into the receptacle
  int observations = 0;  ///< number of camera observations of the tool
  int refused = 0;       ///< number of motions and single commands out of reach
};

/// Runs the task over all fragments on an arm of its own; fewer when cancelled. Fragments and detection
/// errors are the same for every method.
std::vector<FragmentRun> debridementTask(const robot::Description& robot, const simulation::ToolTruth& truth,
                                         const learning::CorrectionModel& model, DebridementMethod method,
                                         const DebridementTaskOptions& options,
                                         const base::Progress* progress = nullptr);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::DebridementMethod> {
  using M = capstan::experiments::DebridementMethod;
  static constexpr std::array value = {std::pair{M::kReplanning, "replanning"},
                                       std::pair{M::kCorrected, "learned correction"},
                                       std::pair{M::kOpenLoop, "no correction"},
                                       std::pair{M::kWhereUncertain, "learned, observing at low confidence"}};
};

template <>
struct capstan::base::KeysOf<capstan::experiments::DebridementMethod> {
  using M = capstan::experiments::DebridementMethod;
  static constexpr std::array value = {
      std::pair{M::kReplanning, "replanning"}, std::pair{M::kCorrected, "corrected"},
      std::pair{M::kOpenLoop, "open_loop"}, std::pair{M::kWhereUncertain, "corrected_with_camera_checks"}};
};
