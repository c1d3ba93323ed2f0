#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/tracking/options.h"

namespace capstan::studies {

/// Tracking with measurement noise from its sources against the UKF paper's constant R.
struct NoiseStudyOptions {
  std::string truth = "default";  ///< as simulation::SimulationRequest::truth
  double duration = 60.0;         ///< of each block transfer [s]
  int trials = 2;                 ///< with seeds seed, seed + 1, …
  std::uint64_t seed = 1;
  int threads = 2;     ///< the result does not depend on it
  bool images = true;  ///< false: tip positions, whose noise is stated, not seen
};

/// One filter of the comparison, over all trials.
struct NoiseVariant {
  std::string name;  ///< in words
  tracking::TrackingOptions options;
  bool true_radius = true;  ///< the estimator knows the true pulley radii; false: nominal
  Eigen::Vector3d kinematic = Eigen::Vector3d::Zero(), camera = kinematic,
                  ukf = kinematic;  ///< RMS errors [rad, rad, m]
  double nis = 0.0, nees = 0.0;     ///< means over their 3 degrees of freedom
};

struct NoiseStudy {
  std::string truth;  ///< its name
  std::vector<NoiseVariant> variants;
  bool cancelled = false;  ///< nothing else is filled in

  /// RMS of the UKF, variant `i` by variant `j`.
  Eigen::Vector3d ratio(std::size_t i, std::size_t j) const {
    return variants[i].ukf.cwiseQuotient(variants[j].ukf);
  }
  /// The constant R with the same robot as variant `i`.
  std::size_t constantBeside(std::size_t i) const {
    for (std::size_t j = 0; j < variants.size(); ++j)
      if (variants[j].name == "constant" && variants[j].true_radius == variants[i].true_radius) return j;
    return i;
  }
};

/// Variants, each with the true pulley radii and again with the nominal ones: R from its sources (the
/// defaults); the constant R of the options; R from the pixels alone, without registration and clock; R so
/// large that the camera says nothing. All see the same samples of each trial. Deterministic and cancellable.
/// Throws base::InputError as simulation::optionsOf does.
NoiseStudy studyNoise(const NoiseStudyOptions& options, base::Progress& progress);

}  // namespace capstan::studies
