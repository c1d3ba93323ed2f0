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
#include "core/tracking/snapshot.h"

namespace capstan::studies {

/// How long, at which speeds and occlusions, joints whose motor encoder failed are known from the camera
/// alone as well as twice the normal error: block transfers of the simulated robot, played slower and faster,
/// tracked side by side with all encoders and with one, or all, failed. The robot goes on to be controlled
/// with its encoders; only the estimator loses them. Two normal errors stand for comparison: the estimator's
/// own, and that of one which knows the nominal robot only, as the UKF paper's does.
struct MotorFailureStudyOptions {
  double duration = 60.0;                                    ///< of failure [s]
  double warm_up = 5.0;                                      ///< before it, everything in order [s]
  std::vector<double> speeds = {0.25, 0.5, 1.0, 2.0};        ///< relative to a 200 s block transfer
  std::vector<double> occlusions = {0.0, 20.0, 40.0, 60.0};  ///< [%], in intervals of 2 s
  int seeds = 3;
  std::uint64_t seed = 1;                                    ///< the first
  tracking::MotorFault fault = tracking::MotorFault::kLost;  ///< or kFrozen, which has to be found first
  /// The filter knows the true pulley radii, as that of an identified robot does; false: the nominal ones.
  bool true_radii = true;
  bool images = false;            ///< rendered images instead of tip positions
  std::string truth = "default";  ///< as simulation::SimulationRequest::truth
  int threads = 2;                ///< trials at the same time; the result does not depend on it
  std::filesystem::path out;      ///< finished trials are kept here and not run again; empty: nowhere
  std::string software = base::software();  ///< the program, which a kept trial must come from
};

/// The error, all encoders in order, that a failed joint is compared with.
enum class NormalError {
  kOwn,     ///< of the same estimator
  kNominal  ///< of one that knows nominal pulley radii only: the UKF paper's setting
};
inline constexpr std::size_t kNormalErrors = 2;

/// How long a failed joint's error stays within twice a normal one.
struct Endurance {
  /// From the failure until the RMS over the window first exceeds it [s]; the trial's end where it never
  /// does. Over seeds: the median.
  double held = 0.0;
  double share = 0.0;  ///< of the time in which it does not exceed it
  int whole = 0;       ///< trials in which it never did
};

/// One failure in one trial, or over its seeds. The window is the last 2 s.
struct MotorFailureResult {
  int motor = 0;  ///< 0, 1, 2; 3: all
  double speed = 1.0, occlusion = 0.0;
  std::array<Eigen::Vector3d, kNormalErrors> normal_rms;  ///< of q_ukf from the failure on [rad, rad, m]
  Eigen::Vector3d failed_rms;                             ///< the same with the failure
  std::array<Endurance, kNormalErrors> within;            ///< twice each normal error
  double found = 0.0;  ///< from the failure until the pipeline knew [s]; NaN: it never did
  double nees = 0.0;   ///< mean of the failed run over its 3 degrees of freedom

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
  bool cancelled = false;  ///< there are no cells then; trials that were done are kept in options.out
};

/// Throws base::InputError as the truth file's reader does.
MotorFailureStudy runMotorFailureStudy(const MotorFailureStudyOptions& options, base::Progress& progress);

/// A row a motor and speed, and for each occlusion how long the error stays within twice `normal`.
base::Table mapOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options,
                  NormalError normal);
/// Every number of every cell.
base::Table detailsOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options);

}  // namespace capstan::studies

template <>
struct capstan::base::NamesOf<capstan::studies::NormalError> {
  using E = capstan::studies::NormalError;
  static constexpr std::array value = {std::pair{E::kOwn, "own"}, std::pair{E::kNominal, "nominal"}};
};
