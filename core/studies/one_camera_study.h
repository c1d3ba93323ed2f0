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
#include "core/live/occlusion.h"

namespace capstan::studies {

/// Options of the study of one blocked camera: the block transfer of experiment D of the UKF paper with one
/// camera blocked. The filter observes transmission kinematics meanwhile (the paper's hard switch), or the
/// ray of the other camera.
struct OneCameraStudyOptions {
  std::vector<double> shares = {10.0, 20.0, 40.0, 60.0, 80.0};  ///< of the time, in intervals of 2 s [%]
  live::BlockedCameras blocked = live::BlockedCameras::kLeft;
  std::string truth = "default";  ///< see simulation::SimulationRequest::truth
  double duration = 200.0;        ///< [s]
  std::uint64_t seed = 401;
  int threads = 2;  ///< number of worker threads; the result does not depend on it
  /// Folder of finished trials, which are not run again unless program, options or inputs changed; empty:
  /// none.
  std::filesystem::path out;
  std::string software = base::software();  ///< program that a stored trial must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

/// Result of one filter on one recording. Joints in rad, rad, m.
struct OneCameraResult {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();      ///< RMS error
  Eigen::Vector3d blocked = Eigen::Vector3d::Zero();  ///< RMS error while the camera was blocked
  double nis = 0.0;                                   ///< mean NIS / 3 of accepted pairs of images
  double ray_nis = 0.0;                               ///< mean NIS / 2 of accepted rays; NaN: none
  double ray_share = 0.0;  ///< accepted rays, of the camera samples with one blocked camera
};

struct OneCameraComparison {
  double share = 0.0;  ///< of the time with a blocked camera [%]
  std::string robot;   ///< "nominal" or "true radii"
  std::string filter;  ///< "six_state" or "augmented"
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero();
  OneCameraResult hard_switch, ray;
};

struct OneCameraStudy {
  std::vector<OneCameraComparison> comparisons;
  std::vector<std::string> notices;
  bool cancelled = false;
};

/// Runs the study: every recording is tracked with the nominal robot and with the true pulley radii, by the
/// six-state and the augmented filter, with the hard switch and with the ray. Deterministic and cancellable.
OneCameraStudy runOneCameraStudy(const OneCameraStudyOptions& options, base::Progress& progress);

/// Table with one row per comparison and joint [deg, deg, mm].
base::Table comparisonsOf(const OneCameraStudy& study);

}  // namespace capstan::studies
