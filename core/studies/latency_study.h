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
#include "core/experiments/specification.h"

namespace capstan::studies {

/// Options of the study of the camera's clock delay as an estimated parameter. In simulated block transfers
/// the camera stamps are late or early. Both methods identify delay, pose and `parameters` together from
/// motors and cameras alone, in one pass or two, each with its own estimate of the delay
/// (identification/delay_passes.h). Then the recordings are tracked with the robot of the batch method: with
/// the original stamps, with stamps corrected by the delay estimate of the batch method, and with stamps
/// corrected by the true delay. The prior of the delay is 0 ± prior_sigma, which is wider than the delays
/// studied; the default of `identify` is CameraPoseOptions::delay_sigma.
struct LatencyStudyOptions {
  std::vector<double> delays = {-0.02, -0.01, 0.0, 0.01,
                                0.02,  0.03,  0.04};  ///< true delays of the stamps [s]
  double duration = 60.0;                             ///< duration of each recording [s]
  int seeds = 3;                                      ///< number of recordings per delay
  std::uint64_t seed = 1;                             ///< seed of the first recording
  double prior_sigma = 0.05;  ///< prior standard deviation of the delay about zero [s]
  std::string parameters = "r_l,k_e,b_e";
  std::string truth = "default";  ///< see simulation::SimulationRequest::truth
  int threads = 2;                ///< number of recordings in parallel; the result does not depend on it
  std::filesystem::path out;      ///< folder of finished recordings, which are not run again; empty: none
  std::string software = base::software();  ///< program that a stored result must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

struct LatencyTrial {
  double truth = 0.0;  ///< true delay [s]
  std::uint64_t seed = 0;
  std::array<double, 2> delay{}, sigma{};  ///< estimates of dual UKF and batch [s]
  /// RMS errors [rad, rad, m] of q_ukf, of q_cam, and of q_ukf with all motor encoders declared failed; each
  /// with the original stamps, with stamps corrected by the batch estimate, and with stamps corrected by the
  /// truth.
  std::array<std::array<Eigen::Vector3d, 3>, 3> rms;

  bool covered(experiments::Method method) const;  ///< true when the 95 % interval covers the truth
};

struct LatencyStudy {
  std::vector<LatencyTrial> trials;  ///< by delay, seed
  std::vector<std::string> notices;
  bool cancelled = false;  ///< true: there are no trials; finished ones are stored in options.out
};

/// Runs the study. Throws base::InputError as the truth file's reader does.
LatencyStudy runLatencyStudy(const LatencyStudyOptions& options, base::Progress& progress);

/// Table with one row per delay: estimates ± σ of both methods (means over seeds) and coverage of the truth.
base::Table estimatesOf(const LatencyStudy& study, const LatencyStudyOptions& options);
/// Table with one row per delay: RMS of tracking with original, corrected and true stamps.
base::Table gainOf(const LatencyStudy& study, const LatencyStudyOptions& options);

}  // namespace capstan::studies
