#pragma once

#include <array>
#include <vector>

#include "core/experiments/training_motions.h"
#include "core/learning/poses/next_observation.h"

/// Surgical debridement on a simulated arm (GPR paper, section V-D): each foam fragment is found, approached,
/// grasped and taken to a receptacle.
namespace capstan::experiments {

/// How the arm gets where it is to be.
enum class DebridementMethod {
  kReplanning,      ///< slow, in short pieces, with an observation and a new plan between, as in prior
                    ///< work
  kCorrected,       ///< fast, without looking, through the learned correction
  kOpenLoop,        ///< fast, without looking, as the native controller goes
  kWhereUncertain,  ///< as kCorrected while the correction's confidence is high (next_observation.h), then as
                    ///< kReplanning
};
inline constexpr std::size_t kDebridementMethods = 4;

struct DebridementTaskOptions {
  int fragments = 100;
  Eigen::Vector3d beside = Eigen::Vector3d::Zero();  ///< of the grid: lateral, depth, height [m]
  static constexpr double kSlow = 0.01;              ///< of kReplanning [m/s]: the paper's prior work
  static constexpr double kFast = 0.06;              ///< of the others [m/s]: the paper's
  double piece = 0.02;                               ///< length of a piece of kReplanning [m]
  double near = 0.002;                               ///< distance within which kReplanning has arrived [m]
  learning::CorrectionMode mode = learning::CorrectionMode::kEndPoint;  ///< of kCorrected
  learning::ObservationOptions observations;                            ///< of kWhereUncertain
  int waypoints = 10;                                                   ///< of a motion without looks
  double most_yaw = 0.35;                                               ///< of fragments [rad]
  static constexpr double kHover = 0.02;           ///< above a fragment, before and after grasping [m]
  static constexpr double kFindTime = 2.0;         ///< that finding a fragment takes [s]
  static constexpr double kPlanTime = 0.5;         ///< that a plan takes [s]
  static constexpr double kJawTime = 0.7;          ///< that the jaws take [s]
  double settle = 0.2;                             ///< at the goal of a motion [s]
  static constexpr double kLook = 0.2;             ///< duration of an observation [s]
  static constexpr double kFindSigma = 5e-4;       ///< of the detected place, across [m]
  static constexpr double kFindDepthSigma = 1e-3;  ///< and in height [m]
  static constexpr double kFindYawSigma = 0.05;    ///< [rad]
  /// A grasp succeeds where the point between the jaws is no further than this from the fragment's middle,
  /// across and along the jaws alike [m], and
  double capture = 0.004;
  static constexpr double kCaptureRotation = 0.45;  ///< largest rotation error of a capture [rad]
  static constexpr double kReceptacle = 0.02;       ///< its radius [m]
  std::uint64_t seed = 1;
};

/// base::InputError: options that make no sense.
void checkDebridementTask(const DebridementTaskOptions& options);

/// One fragment.
struct FragmentRun {
  double time = 0.0;            ///< from being sought to being dropped [s]
  double moving = 0.0;          ///< of it, the arm was on its way [s]
  double off = 0.0;             ///< jaws from the fragment when they closed [m]
  double rotation_error = 0.0;  ///< [rad]
  bool grasped = false;
  bool cleared = false;  ///< grasped, and dropped into the receptacle
  int observations = 0;  ///< of cameras at the tool
  int refused = 0;       ///< motions out of reach, and single commands that were
};

/// All fragments, on an arm of its own. Fewer when cancelled. Fragments, and what is wrong with what is
/// detected of them, are the same in every method.
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
