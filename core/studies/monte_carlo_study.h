#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/base/software.h"
#include "core/base/table.h"
#include "core/experiments/specification.h"
#include "core/stats/interval.h"
#include "core/studies/randomized_robot.h"

namespace capstan::studies {

/// Known-truth recovery: many simulated robots, each identified by both methods from one recording.
struct MonteCarloOptions {
  int samples = 100;
  double duration = 200.0;  ///< of each recording [s]
  std::uint64_t seed = 1;   ///< sample k has seed + k
  /// Noise of each of a marker's image coordinates [px]: recordings hold tip positions instead of pictures. A
  /// little more than the 0.025 that the detector leaves on rendered images (truth files).
  double pixel_sigma = 0.04;
  std::string parameters = "r_l,k_e,b_e,f_c";
  std::string truth;       ///< truth file that samples are drawn around
  std::string trajectory;  ///< as simulation::SimulationRequest::trajectory
  RandomizationSpread spread;
  int threads = 2;  ///< samples at the same time; the result does not depend on it
  /// Finished samples are stored here and not run again unless program, options or robot changed; empty:
  /// nowhere
  std::filesystem::path out;
  std::string software = base::software();  ///< the program that a stored sample must come from
};

/// One parameter of one Monte-Carlo sample, SI.
struct MonteCarloEstimate {
  double truth = 0.0;
  std::array<double, 2> value{}, low{}, high{};  ///< dual UKF, batch; 95 % interval
  std::array<bool, 2> seen{};
};

struct RandomizedRobot {
  std::uint64_t seed = 0;
  std::vector<MonteCarloEstimate> parameters;  ///< in the order of MonteCarloStudy::names
  std::array<double, 2> seconds{};             ///< of computing: dual UKF, batch
};

/// How one method did on one parameter, over the samples whose recording showed it: in the others the
/// interval is the prior's, and that it holds the truth says nothing about the method.
struct Recovery {
  /// Decided by Clopper and Pearson's 95 % interval of the coverage, against kCoverageGoal.
  enum class Verdict { kUnseen, kTooFew, kMet, kMissed };

  int samples = 0;
  int seen = 0;     ///< samples in which the recording at least halved the prior's sigma
  int covered = 0;  ///< of those: truth inside the 95 % interval that was stated
  int covered_of_all = 0;
  double median_error = 0.0;  ///< of |value / truth − 1| where seen; NaN: nowhere
  double median_sigma = 0.0;  ///< stated, of the logarithm, where seen; NaN: nowhere

  /// covered / seen; NaN: nowhere seen.
  double coverage() const;
  /// Of coverage(), 95 %, Clopper and Pearson's; throws base::InputError where it was seen nowhere.
  stats::Interval coverageInterval() const;
  /// Too few samples count while the interval spans the goal.
  Verdict verdict() const;
};

inline constexpr double kCoverageGoal = 0.9;

struct MonteCarloStudy {
  std::vector<std::string> names;        ///< r_l1, k_e2, …
  std::vector<RandomizedRobot> samples;  ///< finished ones, in order of their seeds
  std::vector<std::string> notices;
  bool cancelled = false;

  Recovery recovery(std::size_t parameter, experiments::Method method) const;
};

/// Cancellable; samples finished by then are in the study. Throws base::InputError for files and names that
/// are unusable.
MonteCarloStudy runMonteCarloStudy(const MonteCarloOptions& options, base::Progress& progress);

/// A row a parameter and method.
base::Table recoveriesOf(const MonteCarloStudy& study, const MonteCarloOptions& options);

}  // namespace capstan::studies

template <>
struct capstan::base::NamesOf<capstan::studies::Recovery::Verdict> {
  using V = capstan::studies::Recovery::Verdict;
  static constexpr std::array value = {std::pair{V::kUnseen, "–"}, std::pair{V::kTooFew, "too few"},
                                       std::pair{V::kMet, "met"}, std::pair{V::kMissed, "not met"}};
};

template <>
struct capstan::base::KeysOf<capstan::studies::Recovery::Verdict> {
  using V = capstan::studies::Recovery::Verdict;
  static constexpr std::array value = {std::pair{V::kUnseen, "not_observed"},
                                       std::pair{V::kTooFew, "too_few"}, std::pair{V::kMet, "met"},
                                       std::pair{V::kMissed, "not_met"}};
};
