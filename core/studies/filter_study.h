#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/table.h"
#include "core/tracking/transmission_estimate.h"

namespace capstan::studies {

/// The six-state filter and the augmented one on the same samples.
struct FilterStudyOptions {
  /// Recordings to track: measured tables or sessions with joint encoders. Empty: simulated sessions.
  std::vector<std::filesystem::path> recordings;
  std::filesystem::path robot;    ///< robot file of recordings that bring none; empty: the left RAVEN-II
  std::string truth = "default";  ///< of simulations, as simulation::SimulationRequest::truth
  double duration = 200.0;        ///< of each block transfer [s]
  std::uint64_t seed = 1;         ///< the first
  int seeds = 10;                 ///< seed, seed + 1, …
  std::vector<double> occlusions = {0.0};  ///< share of the time that both cameras are blocked, 2 s each [%]
  bool images = true;                      ///< false: tip positions
  bool disturbed = false;                  ///< each session with each of disturbances(), by tip positions
  double settled = 20.0;                   ///< NIS counts from here on [s]
  int threads = 2;                         ///< the result does not depend on it
};

/// One filter on one recording.
struct FilterResult {
  Eigen::Vector3d ukf = Eigen::Vector3d::Zero();  ///< RMS error [rad, rad, m]
  Eigen::Vector3d seen = ukf;                     ///< the same where the camera was accepted
  double nis = 0.0;  ///< mean over 3 degrees of freedom of accepted camera samples, once settled
  double consistent =
      0.0;            ///< share of camera samples whose running mean of NIS lies in its 95 % band, settled
  double nees = 0.0;  ///< of joint positions, over 3 degrees of freedom
  tracking::TransmissionEstimate transmission;  ///< at the end
};

/// One recording tracked with one robot.
struct FilterComparison {
  std::string recording;  ///< "seed 3", or a file's name
  std::string robot;      ///< "nominal", "true radii", or the robot's name
  std::string disturbance = "none";
  double occlusion = 0.0;                                                   ///< [%]
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero(), camera = kinematic;  ///< RMS errors [rad, rad, m]
  FilterResult six_state, augmented;
};

struct FilterStudy {
  std::vector<FilterComparison> comparisons;
  std::vector<std::string> notices;
  bool cancelled = false;  ///< comparisons are those that were finished
};

/// Every simulation is tracked with the nominal robot and again with the true pulley radii. Deterministic and
/// cancellable. Throws base::InputError as the sources do.
FilterStudy runFilterStudy(const FilterStudyOptions& options, base::Progress& progress);

/// A row a comparison: RMS of kinematics, camera, six-state and augmented filter [deg, deg, mm], NIS.
base::Table comparisonsOf(const FilterStudy& study);

}  // namespace capstan::studies
