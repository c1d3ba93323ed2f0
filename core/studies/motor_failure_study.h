#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/base/software.h"
#include "core/base/table.h"
#include "core/experiments/shard.h"
#include "core/tracking/snapshot.h"

namespace capstan::studies {

/// Options of the study of motor encoder failures. The study measures, for each speed and occlusion, how long
/// the error of joints with a failed encoder stays within twice the normal error. Simulated block transfers,
/// played slower and faster, are tracked in parallel with all encoders and with one or all failed. The
/// robot's controller keeps its encoders; only the estimator loses them. There are two normal errors: that of
/// the same estimator, and that of an estimator with the nominal robot, as in the UKF paper.
struct MotorFailureStudyOptions {
  double duration = 60.0;                                    ///< duration of the failure [s]
  double warm_up = 5.0;                                      ///< time before the failure [s]
  std::vector<double> speeds = {0.25, 0.5, 1.0, 2.0};        ///< speeds relative to a 200 s block transfer
  std::vector<double> occlusions = {0.0, 20.0, 40.0, 60.0};  ///< shares of the time, in intervals of 2 s [%]
  int seeds = 3;                                             ///< number of trials per speed and occlusion
  std::uint64_t seed = 1;                                    ///< seed of the first trial
  tracking::MotorFault fault = tracking::MotorFault::kLost;  ///< or kFrozen, which the pipeline must detect
  /// True: the filter knows the true pulley radii, as after identification; false: the nominal ones.
  bool true_radii = true;
  bool images = false;            ///< true: rendered images instead of tip positions
  std::string truth = "default";  ///< see simulation::SimulationRequest::truth
  int threads = 2;                ///< number of trials in parallel; the result does not depend on it
  std::filesystem::path out;      ///< folder of finished trials, which are not run again; empty: none
  std::string software = base::software();  ///< program that a stored trial must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

/// Normal error, with all encoders working, to which the error of a failed joint is compared.
enum class NormalError {
  kOwn,     ///< error of the same estimator
  kNominal  ///< error of an estimator with nominal pulley radii, as in the UKF paper
};
inline constexpr std::size_t kNormalErrors = 2;

/// Time for which the error of a failed joint stays within twice a normal error.
struct Endurance {
  /// Time from the failure until the RMS over the window first exceeds the limit [s]; the trial's end where
  /// it never does. Over seeds: the median.
  double held = 0.0;
  double share = 0.0;  ///< share of the time within the limit
  int whole = 0;       ///< number of trials within the limit all the time
};

/// Result for one failed motor, speed and occlusion: of one trial, or combined over trials with different
/// seeds. RMS over the window: over the 2 s before each time.
struct MotorFailureResult {
  int motor = 0;  ///< failed motor 0, 1, 2; 3: all
  double speed = 1.0, occlusion = 0.0;
  std::array<Eigen::Vector3d, kNormalErrors>
      normal_rms;                               ///< normal RMS of q_ukf after the failure [rad, rad, m]
  Eigen::Vector3d failed_rms;                   ///< RMS of q_ukf with the failure [rad, rad, m]
  std::array<Endurance, kNormalErrors> within;  ///< endurance for each normal error
  double found = 0.0;  ///< time from the failure to its detection [s]; NaN: never detected
  double nees = 0.0;   ///< mean NEES / 3 degrees of freedom of the run with the failure

  const Eigen::Vector3d& normal(NormalError which) const {
    return normal_rms[static_cast<std::size_t>(which)];
  }
  const Endurance& endurance(NormalError which) const { return within[static_cast<std::size_t>(which)]; }
  /// Largest ratio of failed to normal RMS among the failed joints.
  double ratio(NormalError which) const;
};

struct MotorFailureStudy {
  std::vector<MotorFailureResult> cells;  ///< by motor, speed, occlusion
  std::vector<std::string> notices;
  bool cancelled = false;  ///< true: there are no cells; finished trials are stored in options.out
};

/// Runs the study. Throws base::InputError as the truth file's reader does.
MotorFailureStudy runMotorFailureStudy(const MotorFailureStudyOptions& options, base::Progress& progress);

/// Table with one row per motor and speed: for each occlusion, how long the error stays within twice
/// `normal`.
base::Table mapOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options,
                  NormalError normal);
/// Table of all numbers of all cells.
base::Table detailsOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options);

}  // namespace capstan::studies

template <>
struct capstan::base::NamesOf<capstan::studies::NormalError> {
  using E = capstan::studies::NormalError;
  static constexpr std::array value = {std::pair{E::kOwn, "own"}, std::pair{E::kNominal, "nominal"}};
};
