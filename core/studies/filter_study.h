#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/software.h"
#include "core/base/table.h"
#include "core/experiments/shard.h"
#include "core/tracking/transmission_estimate.h"

namespace capstan::studies {

/// Options of the comparison of the six-state and the augmented filter on the same samples.
struct FilterStudyOptions {
  /// Recordings to track: measured tables or sessions with joint encoders. Empty: simulated sessions.
  std::vector<std::filesystem::path> recordings;
  std::filesystem::path robot;    ///< robot file of recordings that contain none; empty: the left RAVEN-II
  std::string truth = "default";  ///< truth of simulations; see simulation::SimulationRequest::truth
  double duration = 200.0;        ///< duration of each block transfer [s]
  std::uint64_t seed = 1;         ///< seed of the first simulation
  int seeds = 10;                 ///< number of simulations: seed, seed + 1, …
  std::vector<double> occlusions = {0.0};  ///< shares of the time with both cameras blocked, 2 s each [%]
  bool images = true;                      ///< false: tip positions
  bool disturbed = false;  ///< true: each session with each of disturbances(), by tip positions
  double settled = 20.0;   ///< start time of the NIS statistics [s]
  int threads = 2;         ///< number of worker threads; the result does not depend on it
  /// Folder of finished trials, which are not run again unless program, options or inputs changed; empty:
  /// none.
  std::filesystem::path out;
  std::string software = base::software();  ///< program that a stored trial must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

/// Result of one filter on one recording.
struct FilterResult {
  Eigen::Vector3d ukf = Eigen::Vector3d::Zero();  ///< RMS error [rad, rad, m]
  Eigen::Vector3d seen = ukf;                     ///< RMS error where the camera was accepted [rad, rad, m]
  double nis = 0.0;         ///< mean NIS / 3 degrees of freedom of accepted camera samples, once settled
  double consistent = 0.0;  ///< share of settled camera samples with the running mean of NIS in its 95 % band
  double nees = 0.0;        ///< mean NEES of joint positions / 3 degrees of freedom
  tracking::TransmissionEstimate transmission;  ///< estimate at the end
};

/// Comparison of both filters on one recording with one robot.
struct FilterComparison {
  std::string recording;  ///< "seed 3", or a file's name
  std::string robot;      ///< "nominal", "true radii", or the robot's name
  std::string disturbance = "none";
  double occlusion = 0.0;                                                   ///< share of the time [%]
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero(), camera = kinematic;  ///< RMS errors [rad, rad, m]
  FilterResult six_state, augmented;
};

struct FilterStudy {
  std::vector<FilterComparison> comparisons;
  std::vector<std::string> notices;
  bool cancelled = false;  ///< true: only finished comparisons are filled
};

/// Runs the study. Every simulation is tracked with the nominal robot and again with the true pulley radii.
/// Deterministic and cancellable. Throws base::InputError as the sources do.
FilterStudy runFilterStudy(const FilterStudyOptions& options, base::Progress& progress);

/// Table with one row per comparison: RMS of kinematics, camera, six-state and augmented filter [deg, deg,
/// mm], NIS.
base::Table comparisonsOf(const FilterStudy& study);

}  // namespace capstan::studies
