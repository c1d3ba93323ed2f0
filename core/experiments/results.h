#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/experiments/specification.h"
#include "core/tracking/snapshot.h"

/// What an experiment found, with everything that is needed to redraw or recompute it. SI units: joints as
/// rad, rad, m. Not a number: not known. Series are rounded to 1e-9 (joints, errors) and 1e-6 s (times).
namespace capstan::experiments {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
inline Eigen::Vector3d noJoints() { return Eigen::Vector3d::Constant(kNone); }

/// Estimators whose errors are compared.
enum class Estimator {
  kKinematic,   ///< transmission kinematics: of an experiment's nominal robot, else of the filter's robot
  kIdentified,  ///< transmission kinematics of the robot that the estimator assumes
  kCamera,      ///< stereo vision, where the filter took it, at its own times
  kUkf
};
inline constexpr std::size_t kEstimators = 4;

/// The trajectory, 20 a second.
struct TrajectoryPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d q_true = noJoints();
  Eigen::Vector3d q_kin = noJoints();  ///< of the nominal robot
  Eigen::Vector3d q_cam = noJoints();  ///< NaN where the filter took no camera sample since the last point
  Eigen::Vector3d q_ukf = noJoints(), sigma = noJoints();
  bool occluded = false;  ///< the cameras were blocked
};

/// Errors of one instant, estimate − reference: kinematic, identified and UKF 100 a second.
struct ErrorPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d kinematic = noJoints(), identified = noJoints(), ukf = noJoints();
  bool occluded = false;
};

/// One camera sample that the filter took, at its time of exposure.
struct CameraPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d q = noJoints(), error = noJoints();
};

/// Names and texts of the files that a trial was made from; empty: none.
struct TrialInputs {
  std::string nominal;     ///< robot file: the plant before its truth, and the comparison's kinematics
  std::string robot;       ///< robot file that the estimator assumed
  std::string truth;       ///< truth file of a simulation
  std::string trajectory;  ///< trajectory of a simulation
  std::string tracking;    ///< filter options
  std::string recording;   ///< name, size and checksum (base::checksumOfFile()) of a recorded trial's file
};

/// How a robot moved in one trial, and what was made of it.
struct TrialMotion {
  std::string name;
  double begin = 0.0, end = 0.0;  ///< of the motor samples [s]
  double occluded_share = 0.0;    ///< of the motor samples
  std::vector<TrajectoryPoint> trajectory;
  std::vector<CameraPoint> camera;

  double duration() const { return end - begin; }
};

struct TrialResult : TrialMotion {
  bool simulated = true;
  std::uint64_t seed = 0;       ///< of a simulation
  OcclusionSpec occlusion;      ///< as requested
  bool images = false;          ///< markers were found in pictures
  bool own_kinematics = false;  ///< in place of joint encoders: the robot's own kinematics, no truth
  bool reference = false;       ///< joint encoders fitted: there are errors
  std::uint64_t motor_samples = 0, camera_samples = 0;
  std::array<std::uint64_t, 8> gates{};  ///< camera samples by tracking::Gate
  std::array<Eigen::Vector3d, kEstimators> rms = {noJoints(), noJoints(), noJoints(),
                                                  noJoints()};  ///< over every sample, not the thinned series
  std::array<std::uint64_t, kEstimators> counts{};              ///< samples behind it
  /// RMS of the augmented filter on the same samples; rms of kUkf is that of the paper's six states.
  Eigen::Vector3d rms_augmented = noJoints();
  double nis = kNone;   ///< mean of accepted camera samples over its 3 degrees of freedom
  double nees = kNone;  ///< mean of the positions over its 3 degrees of freedom
  std::uint64_t rescues = 0, late_dropped = 0;
  std::vector<ErrorPoint> errors;
  TrialInputs inputs;
  double seconds = 0.0;  ///< of computing; in timing.json, as it differs from run to run
  /// Names of a run that was no experiment (resultsOfErrors()), else empty; in no file. See trial_robots.h.
  std::string kinematic_robot, filter_robot;

  const Eigen::Vector3d& rmsOf(Estimator which) const { return rms[static_cast<std::size_t>(which)]; }
  /// |error| of joint 0…2 over the thinned series [rad or m].
  std::vector<double> absoluteErrors(Estimator which, int joint) const;
  std::vector<double> errorsOf(Estimator which, int joint) const;
};

/// What one method found of one parameter, SI.
struct ParameterEstimate {
  double value = kNone, sigma = kNone;  ///< standard deviation to first order
  double low = kNone, high = kNone;     ///< 95 % interval
  bool seen = false;                    ///< the recording at least halves the prior's sigma
  std::string advice;                   ///< why not, in words
};

struct IdentifiedParameter {
  std::string name, words;  ///< "r_l1", "joint 1's pulley radius"
  std::string unit;         ///< for people
  double scale = 1.0;       ///< from SI to that unit
  double nominal = kNone;   ///< where the methods started
  double truth = kNone;     ///< of a simulation
  ParameterEstimate dual_ukf, batch;
  std::optional<double> settled_at;  ///< since when the dual UKF's value has rested at its goal [s]
  std::string convergence;           ///< the same in words
};

/// One line of the dual UKF's trace: value and standard deviation of each parameter, SI.
struct ParameterTracePoint {
  double t = 0.0;  ///< from the recording's start [s]
  std::vector<double> value, sigma;
};

struct IdentificationResult {
  std::vector<std::string> recordings;  ///< trials that it was made from
  /// Of each of them, by the filter that collected the data: it assumed the robot from before.
  std::vector<TrialMotion> motions;
  Method method = Method::kBatch;  ///< whose robot goes on
  std::vector<IdentifiedParameter> parameters;
  std::vector<ParameterTracePoint> trace;
  Eigen::MatrixXd dual_correlation, batch_correlation;  ///< of the logarithms
  std::string dual_end, batch_end;                      ///< "recording ended", "converged", …
  int dual_observations = 0, batch_observations = 0, batch_iterations = 0;
  double dual_nis = kNone, batch_residual = kNone;  ///< 1: noise only
  /// CameraPose and its standard deviation: turn [rad], shift [m], delay [s].
  Eigen::Matrix<double, 7, 1> camera = Eigen::Matrix<double, 7, 1>::Constant(kNone), camera_sigma = camera;
  double duration = 0.0;   ///< of the motor samples [s]
  std::uint64_t seed = 0;  ///< of the first trial
  TrialInputs inputs;      ///< of the first trial
  std::string robot;       ///< identified robot file, its origin in comments on top
  bool found = true;       ///< a method left estimates; in no file: without any there is no result
  std::string choice;      ///< why `method` is not the one requested; empty: it is; in no file
  double collect_seconds = 0.0, dual_seconds = 0.0, batch_seconds = 0.0;  ///< in timing.json

  /// The method whose robot goes on.
  const ParameterEstimate& chosen(const IdentifiedParameter& parameter) const {
    return method == Method::kDualUkf ? parameter.dual_ukf : parameter.batch;
  }
};

struct Results {
  std::string name, title;
  Work work = Work::kTrack;
  std::string software;                                ///< program and version that computed them
  std::string specification;                           ///< its text
  bool simulated = true;                               ///< no trial is of a real robot
  std::vector<TrialResult> trials;                     ///< of work: track
  std::optional<IdentificationResult> identification;  ///< of work: identify
  double wall_seconds = 0.0;                           ///< of the run that computed them; in timing.json
  int resumed = 0;                                     ///< trials that an earlier run had finished
  /// Finished trials that are kept, of the experiments that it needs, too: the next run goes on from them.
  int kept = 0;
  std::vector<std::string> notices;  ///< damaged files and the like; in no file
  bool cancelled = false;            ///< incomplete: nothing was written but finished trials
};

/// Writes into `folder` (created): results.json, series.json, timing.json, and as CSV
/// <trial>-trajectory.csv and -camera.csv; of a tracked trial -errors.csv, of an identification
/// parameters.csv, trace.csv and robot.yaml. Same results, same bytes, but for timing.json. Each file appears
/// whole or not at all; results.json and series.json carry one stamp, so that a mixture of two runs is
/// recognised. Throws base::InputError when one cannot be written.
void writeResults(const Results& results, const std::filesystem::path& folder);

/// Reads what writeResults() wrote. Throws base::InputError with the remedy for a folder without results, a
/// damaged file, one of another version, or numbers and series of two runs.
Results readResults(const std::filesystem::path& folder);

/// `text` as part of a file's name: letters, digits, - and _.
std::string fileNameOf(const std::string& text);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::Estimator> {
  using E = capstan::experiments::Estimator;
  static constexpr std::array value = {std::pair{E::kKinematic, "kinematic"},
                                       std::pair{E::kIdentified, "identified kinematic"},
                                       std::pair{E::kCamera, "camera"}, std::pair{E::kUkf, "UKF"}};
};
