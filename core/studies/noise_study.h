#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/tracking/options.h"

namespace capstan::studies {

/// Options of the comparison of tracking with measurement noise from its sources and with the constant R of
/// the UKF paper.
struct NoiseStudyOptions {
  std::string truth = "default";  ///< see simulation::SimulationRequest::truth
  double duration = 60.0;         ///< duration of each block transfer [s]
  int trials = 2;                 ///< number of trials, with seeds seed, seed + 1, …
  std::uint64_t seed = 1;
  int threads = 2;     ///< number of worker threads; the result does not depend on it
  bool images = true;  ///< false: tip positions, whose noise is stated, not measured
};

/// One filter of the comparison, over all trials.
struct NoiseVariant {
  std::string name;  ///< name in words
  tracking::TrackingOptions options;
  bool true_radius = true;  ///< true: the estimator knows the true pulley radii; false: the nominal ones
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero(), camera = kinematic,
                  ukf = kinematic;  ///< RMS errors [rad, rad, m]
  double nis = 0.0, nees = 0.0;     ///< mean NIS / 3 and NEES / 3 degrees of freedom
};

struct NoiseStudy {
  std::string truth;  ///< name of the truth
  std::vector<NoiseVariant> variants;
  bool cancelled = false;  ///< true: nothing else is filled in

  /// Ratio of the UKF's RMS, variant `i` / variant `j`.
  Eigen::Vector3d ratio(std::size_t i, std::size_t j) const {
    return variants[i].ukf.cwiseQuotient(variants[j].ukf);
  }
  /// Index of the variant with constant R and the same robot as variant `i`.
  std::size_t constantBeside(std::size_t i) const {
    for (std::size_t j = 0; j < variants.size(); ++j)
      if (variants[j].name == "constant" && variants[j].true_radius == variants[i].true_radius) return j;
    return i;
  }
};

/// Runs the study. Variants: R from its sources (the defaults); the constant R of the options; R from the
/// pixels alone, without registration and clock; R so large that the camera has no effect. Each one runs with
/// the true and with the nominal pulley radii, on the same samples. Deterministic and cancellable. Throws
/// base::InputError as simulation::optionsOf() does.
NoiseStudy studyNoise(const NoiseStudyOptions& options, base::Progress& progress);

}  // namespace capstan::studies
