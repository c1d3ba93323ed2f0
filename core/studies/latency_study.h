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
#include "core/experiments/specification.h"

namespace capstan::studies {

/// The camera's clock delay as an estimated parameter: simulated block transfers whose camera stamps are late
/// (or early), each identified by both methods, delay, pose and `parameters` together, from motors and
/// cameras alone, in as many passes as the delay asks for, each method by its own delay
/// (identification/delay_passes.h); then tracked with the stamps as they are, corrected by what the batch
/// method estimated, and corrected by the truth, all with the robot that the batch method found. The prior of
/// the delay is 0 ± prior_sigma, wide beside the delays studied; identify's own default is
/// CameraPoseOptions::delay_sigma.
struct LatencyStudyOptions {
  std::vector<double> delays = {-0.02, -0.01, 0.0, 0.01, 0.02, 0.03, 0.04};  ///< cameras.stamp_delay [s]
  double duration = 60.0;                                                    ///< of each recording [s]
  int seeds = 3;
  std::uint64_t seed = 1;     ///< the first
  double prior_sigma = 0.05;  ///< of the delay about zero [s]: nothing is known to within this
  std::string parameters = "r_l,k_e,b_e";
  std::string truth = "default";  ///< as simulation::SimulationRequest::truth
  int threads = 2;                ///< recordings at the same time; the result does not depend on it
  std::filesystem::path out;      ///< finished recordings are kept here and not run again; empty: nowhere
  std::string software = base::software();  ///< the program, which a kept result must come from
};

struct LatencyTrial {
  double truth = 0.0;  ///< [s]
  std::uint64_t seed = 0;
  std::array<double, 2> delay{}, sigma{};  ///< dual UKF, batch [s]
  /// RMS of q_ukf, of q_cam, and of q_ukf with all motor encoders declared failed, each with stamps as they
  /// are, corrected by the batch's estimate, corrected by the truth [rad, rad, m].
  std::array<std::array<Eigen::Vector3d, 3>, 3> rms;

  bool covered(experiments::Method method) const;  ///< the truth lies inside the 95 % interval
};

struct LatencyStudy {
  std::vector<LatencyTrial> trials;  ///< by delay, seed
  std::vector<std::string> notices;
  bool cancelled = false;  ///< there are no trials then; those that were done are kept in options.out
};

/// Throws base::InputError as the truth file's reader does.
LatencyStudy runLatencyStudy(const LatencyStudyOptions& options, base::Progress& progress);

/// A row a delay: estimates ± σ of both methods (means over seeds) and how often the truth is covered.
base::Table estimatesOf(const LatencyStudy& study, const LatencyStudyOptions& options);
/// A row a delay: RMS of tracking as stamped, corrected, and with the true delay.
base::Table gainOf(const LatencyStudy& study, const LatencyStudyOptions& options);

}  // namespace capstan::studies
