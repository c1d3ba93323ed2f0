#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/specification.h"
#include "core/experiments/world.h"

namespace capstan::experiments {

/// Known-truth recovery: many simulated robots, each identified by both methods from one recording.
struct WorldStudyOptions {
  int worlds = 100;
  double duration = 200.0;  ///< of each recording [s]
  std::uint64_t seed = 1;   ///< world k has seed + k
  /// Noise of a marker's position [px]: recordings hold tip positions instead of pictures. What the detector
  /// leaves on rendered pictures, 0.03 px on average and 0.06 px at most in 95 of 100.
  double pixel_sigma = 0.04;
  std::string parameters = "r_l,k_e,b_e,f_c";
  std::string truth;       ///< file that worlds are drawn around
  std::string trajectory;  ///< as simulation::SimulationRequest::trajectory
  WorldSpread spread;
  int threads = 2;            ///< worlds at the same time; the result does not depend on it
  std::filesystem::path out;  ///< finished worlds are kept here and not run again; empty: nowhere
  std::string software;       ///< program and version
};

/// One parameter of one world, SI.
struct WorldEstimate {
  double truth = 0.0;
  std::array<double, 2> value{}, low{}, high{};  ///< dual UKF, batch; 95 % interval
  std::array<bool, 2> seen{};
};

struct World {
  std::uint64_t seed = 0;
  std::vector<WorldEstimate> parameters;  ///< in the order of WorldStudy::names
  std::array<double, 2> seconds{};        ///< of computing: dual UKF, batch
};

/// How one method did on one parameter.
struct Recovery {
  int worlds = 0;
  int covered = 0;                 ///< truth inside the 95 % interval that was stated
  int seen = 0;                    ///< the recording at least halved the prior's sigma
  double median_error = 0.0;       ///< of |value / truth − 1| where seen; NaN: nowhere
  double median_half_width = 0.0;  ///< of the interval by the value, where seen
};

struct WorldStudy {
  std::vector<std::string> names;  ///< r_l1, k_e2, …
  std::vector<World> worlds;       ///< finished ones, in order of their seeds
  std::vector<std::string> notices;
  bool cancelled = false;

  Recovery recovery(std::size_t parameter, Method method) const;
};

/// Cancellable; worlds finished by then are in the study. Throws base::InputError for files and names that
/// are unusable.
WorldStudy runWorldStudy(const WorldStudyOptions& options, base::Progress& progress);

}  // namespace capstan::experiments
