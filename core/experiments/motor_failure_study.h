#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/table.h"
#include "core/tracking/snapshot.h"

namespace capstan::experiments {

/// How long, at which speeds and occlusions, joints whose motor encoder failed are known from the camera
/// alone as well as twice the normal error: block transfers of the simulated robot, played slower and faster,
/// tracked side by side with all encoders and with one, or all, failed. The robot goes on to be controlled
/// with its encoders; only the estimator loses them.
struct MotorFailureStudyOptions {
  double duration = 60.0;                                    ///< of failure [s]
  double warm_up = 5.0;                                      ///< before it, everything in order [s]
  std::vector<double> speeds = {0.25, 0.5, 1.0, 2.0};        ///< by the pace of a 200 s block transfer
  std::vector<double> occlusions = {0.0, 20.0, 40.0, 60.0};  ///< [%], in intervals of 2 s
  int seeds = 3;
  std::uint64_t seed = 1;                                    ///< the first
  tracking::MotorFault fault = tracking::MotorFault::kLost;  ///< or kFrozen, which has to be found first
  /// The filter knows the true pulley radii, as that of an identified robot does; false: the nominal ones.
  bool true_radii = true;
  bool images = false;            ///< rendered pictures instead of tip positions
  std::string truth = "default";  ///< as simulation::SimulationRequest::truth
  int threads = 2;                ///< trials at the same time; the result does not depend on it
};

/// One failure in one trial, or over its seeds. The window is the last 2 s.
struct MotorFailureResult {
  int motor = 0;  ///< 0, 1, 2; 3: all
  double speed = 1.0, occlusion = 0.0;
  Eigen::Vector3d normal_rms, failed_rms;  ///< of q_ukf from the failure on [rad, rad, m]
  /// From the failure until the RMS over the window of a failed joint first exceeds twice its normal RMS
  /// [s]; the trial's end where it never does. Over seeds: the median.
  double held = 0.0;
  double share = 0.0;  ///< of the time in which it does not exceed it
  int whole = 0;       ///< trials in which it never did
  double found = 0.0;  ///< from the failure until the pipeline knew [s]; NaN: it never did
  double nees = 0.0;   ///< mean of the failed run over its 3 degrees of freedom

  /// Largest ratio of failed to normal RMS among the failed joints.
  double ratio() const;
};

struct MotorFailureStudy {
  std::vector<MotorFailureResult> cells;  ///< by motor, speed, occlusion
  bool cancelled = false;
};

/// Throws base::InputError as the truth file's reader does.
MotorFailureStudy runMotorFailureStudy(const MotorFailureStudyOptions& options, base::Progress& progress);

/// A row a motor and speed, and for each occlusion how long the error stays within twice the normal one.
base::Table mapOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options);
/// Every number of every cell.
base::Table detailsOf(const MotorFailureStudy& study, const MotorFailureStudyOptions& options);

}  // namespace capstan::experiments
