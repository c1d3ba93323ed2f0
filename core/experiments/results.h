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

/// Results of an experiment with all data to redraw or recompute them. SI units; joints are rad, rad, m. NaN:
/// not known. Series are rounded to 1e-9 (joints, errors) and 1e-6 s (times).
namespace capstan::experiments {

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
inline Eigen::Vector3d noJoints() { return Eigen::Vector3d::Constant(kNone); }

/// Estimators whose errors are compared.
enum class Estimator {
  kKinematic,   ///< transmission kinematics of the nominal robot (experiments) or of the filter's robot
  kIdentified,  ///< transmission kinematics of the robot that the estimator assumes
  kCamera,      ///< stereo vision at its own times, where the filter accepted it
  kUkf
};
inline constexpr std::size_t kEstimators = 4;

/// One point of the trajectory, 20 per second.
struct TrajectoryPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d q_true = noJoints();
  Eigen::Vector3d q_kin = noJoints();  ///< joints by transmission kinematics of the nominal robot
  Eigen::Vector3d q_cam = noJoints();  ///< NaN without an accepted camera sample since the last point
  Eigen::Vector3d q_ukf = noJoints(), sigma = noJoints();
  bool occluded = false;  ///< true: the cameras were blocked
};

/// Errors estimate − reference at one instant, 100 per second: kinematic, identified and UKF.
struct ErrorPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d kinematic = noJoints(), identified = noJoints(), ukf = noJoints();
  bool occluded = false;
};

/// One camera sample that the filter accepted, at its time of exposure.
struct CameraPoint {
  double t = 0.0;  ///< [s]
  Eigen::Vector3d q = noJoints(), error = noJoints();
};

/// Names and texts of the input files of a trial; empty: none.
struct TrialInputs {
  std::string nominal;     ///< nominal robot file: base of the plant, and kinematics of the comparison
  std::string robot;       ///< robot file that the estimator assumed
  std::string truth;       ///< truth file of a simulation
  std::string trajectory;  ///< trajectory of a simulation
  std::string tracking;    ///< filter options
  std::string recording;   ///< name, size and checksum (base::checksumOfFile()) of a recorded trial's file
};

/// Motion of a robot in one trial, and its estimates.
struct TrialMotion {
  std::string name;
  double begin = 0.0, end = 0.0;  ///< times of the first and last motor samples [s]
  double occluded_share = 0.0;    ///< share of the motor samples under occlusion
  std::vector<TrajectoryPoint> trajectory;
  std::vector<CameraPoint> camera;

  double duration() const { return end - begin; }
};

struct TrialResult : TrialMotion {
  bool simulated = true;
  std::uint64_t seed = 0;       ///< seed of a simulation
  OcclusionSpec occlusion;      ///< requested occlusion
  bool images = false;          ///< true: markers were found in images
  bool own_kinematics = false;  ///< true: the reference is the robot's own kinematics, not joint encoders
  bool reference = false;       ///< true: joint encoders gave a reference, so there are errors
  std::uint64_t motor_samples = 0, camera_samples = 0;
  std::array<std::uint64_t, 8> gates{};  ///< number of camera samples by tracking::Gate, to kUnregistered
  std::array<Eigen::Vector3d, kEstimators> rms = {
      noJoints(), noJoints(), noJoints(), noJoints()};  ///< RMS over all samples, not the thinned series
  std::array<std::uint64_t, kEstimators> counts{};      ///< number of samples of each RMS
  /// RMS of the augmented filter on the same samples; rms of kUkf is that of the paper's six-state filter.
  Eigen::Vector3d rms_augmented = noJoints();
  double nis = kNone;   ///< mean NIS / 3 degrees of freedom of accepted camera samples
  double nees = kNone;  ///< mean NEES / 3 degrees of freedom of the joint positions
  std::uint64_t rescues = 0, late_dropped = 0;
  std::vector<ErrorPoint> errors;
  TrialInputs inputs;
  double seconds = 0.0;  ///< computing time [s]; in timing.json, as it differs from run to run
  /// Names of the robots of a run outside experiments (resultsOfErrors()), else empty; not in a file. See
  /// trial_robots.h.
  std::string kinematic_robot, filter_robot;

  const Eigen::Vector3d& rmsOf(Estimator which) const { return rms[static_cast<std::size_t>(which)]; }
  /// |error| of joint 0…2 over the thinned series [rad or m].
  std::vector<double> absoluteErrors(Estimator which, int joint) const;
  std::vector<double> errorsOf(Estimator which, int joint) const;
};

/// Estimate of one parameter by one method, SI.
struct ParameterEstimate {
  double value = kNone, sigma = kNone;  ///< estimate and its standard deviation to first order
  double low = kNone, high = kNone;     ///< limits of the 95 % interval
  bool seen = false;                    ///< observable: the recording at least halves the prior's sigma
  std::string advice;                   ///< advice for the user; may be empty
};

struct IdentifiedParameter {
  std::string name, words;  ///< "r_l1", "joint 1's pulley radius"
  std::string unit;         ///< unit for people
  double scale = 1.0;       ///< factor from SI to `unit`
  double nominal = kNone;   ///< initial value of both methods
  double truth = kNone;     ///< true value in a simulation
  ParameterEstimate dual_ukf, batch;
  std::optional<double> settled_at;  ///< time since which the dual UKF's value has been settled [s]
  std::string convergence;           ///< convergence in words
};

/// One point of the dual UKF's trace: value and standard deviation of each parameter, SI.
struct ParameterTracePoint {
  double t = 0.0;  ///< time from the recording's start [s]
  std::vector<double> value, sigma;
};

struct IdentificationResult {
  std::vector<std::string> recordings;  ///< names of its trials
  /// Motion of each trial, by the filter that collected the data with the robot before identification.
  std::vector<TrialMotion> motions;
  Method method = Method::kBatch;  ///< method whose robot is used
  std::vector<IdentifiedParameter> parameters;
  std::vector<ParameterTracePoint> trace;
  Eigen::MatrixXd dual_correlation, batch_correlation;  ///< correlations of the logarithms
  std::string dual_end, batch_end;                      ///< "recording ended", "converged", …
  int dual_observations = 0, batch_observations = 0, batch_iterations = 0;
  double dual_nis = kNone, batch_residual = kNone;  ///< NIS / 3, RMS of the whitened residuals; 1: noise only
  /// CameraPose and its standard deviation: rotation [rad], shift [m], delay [s].
  Eigen::Matrix<double, 7, 1> camera = Eigen::Matrix<double, 7, 1>::Constant(kNone), camera_sigma = camera;
  double duration = 0.0;   ///< total duration of the motor samples [s]
  std::uint64_t seed = 0;  ///< seed of the first trial
  TrialInputs inputs;      ///< inputs of the first trial
  std::string robot;       ///< identified robot file; comments at its top give the origin
  bool found = true;       ///< true: a method has estimates; not in a file
  std::string choice;      ///< reason why `method` is not the requested one, else empty; not in a file
  double collect_seconds = 0.0, dual_seconds = 0.0,
         batch_seconds = 0.0;  ///< computing times [s]; in timing.json

  /// Estimate of the method whose robot is used.
  const ParameterEstimate& chosen(const IdentifiedParameter& parameter) const {
    return method == Method::kDualUkf ? parameter.dual_ukf : parameter.batch;
  }
};

struct Results {
  std::string name, title;
  Work work = Work::kTrack;
  std::string software;                                ///< program and version that computed them
  std::string specification;                           ///< text of the specification
  bool simulated = true;                               ///< true: no trial is of a real robot
  std::vector<TrialResult> trials;                     ///< trials of work: track
  std::optional<IdentificationResult> identification;  ///< result of work: identify
  double wall_seconds = 0.0;                           ///< elapsed time of the run [s]; in timing.json
  int resumed = 0;                                     ///< number of trials that an earlier run had finished
  /// Number of stored trials of this experiment and those that it needs; the next run continues from them.
  int kept = 0;
  std::vector<std::string> notices;  ///< notices for the user, e.g. damaged files; not in a file
  bool cancelled = false;            ///< true: incomplete; only finished trials were written
};

/// Writes results.json, series.json and timing.json into `folder` (created), and CSV files:
/// <trial>-trajectory.csv and -camera.csv; for a tracked trial -errors.csv; for an identification
/// parameters.csv, trace.csv and robot.yaml. The same results give the same bytes, except timing.json. Files
/// are written atomically. results.json and series.json have a common stamp, so that a mixture of two runs is
/// detected. Throws base::InputError when a file cannot be written.
void writeResults(const Results& results, const std::filesystem::path& folder);

/// Reads the files of writeResults(). Throws base::InputError with the remedy for a folder without results, a
/// damaged file, a file of another version, or numbers and series of different runs.
Results readResults(const std::filesystem::path& folder);

/// `text` with only letters, digits, - and _, as part of a file name.
std::string fileNameOf(const std::string& text);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::Estimator> {
  using E = capstan::experiments::Estimator;
  static constexpr std::array value = {std::pair{E::kKinematic, "kinematic"},
                                       std::pair{E::kIdentified, "identified kinematic"},
                                       std::pair{E::kCamera, "camera"}, std::pair{E::kUkf, "UKF"}};
};
