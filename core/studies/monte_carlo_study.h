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
#include "core/experiments/shard.h"
#include "core/experiments/specification.h"
#include "core/stats/interval.h"
#include "core/studies/randomized_robot.h"

namespace capstan::studies {

/// Options of the Monte-Carlo study: many simulated robots with known truth, each identified by both methods
/// from one recording.
struct MonteCarloOptions {
  int samples = 100;        ///< number of randomized robots
  double duration = 200.0;  ///< duration of each recording [s]
  std::uint64_t seed = 1;   ///< seed of the first sample; sample k has seed + k
  /// Noise of each image coordinate of a marker [px]; recordings have tip positions instead of images. It is
  /// slightly larger than the detector's 0.025 px on rendered images (truth files).
  double pixel_sigma = 0.04;
  std::string parameters = "r_l,k_e,b_e,f_c";
  std::string truth;       ///< truth file at the centre of the samples
  std::string trajectory;  ///< see simulation::SimulationRequest::trajectory
  int threads = 2;         ///< number of samples in parallel; the result does not depend on it
  /// Folder of finished samples, which are not run again unless program, options or robot changed; empty:
  /// none.
  std::filesystem::path out;
  std::string software = base::software();  ///< program that a stored sample must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

/// One parameter of one Monte-Carlo sample, SI.
struct MonteCarloEstimate {
  double truth = 0.0;
  std::array<double, 2> value{}, low{}, high{};  ///< estimate and 95 % interval by dual UKF, batch
  std::array<bool, 2> seen{};
};

struct RandomizedRobot {
  std::uint64_t seed = 0;
  std::vector<MonteCarloEstimate> parameters;  ///< in the order of MonteCarloStudy::names
  std::array<double, 2> seconds{};             ///< computing time of dual UKF, batch [s]
};

/// Result of one method for one parameter, over the samples (randomized robots) in which the parameter is
/// observable ("seen"). In the other samples the interval is that of the prior, and its coverage does not
/// test the method.
struct Recovery {
  /// Verdict by Clopper and Pearson's 95 % interval of the coverage, against kCoverageGoal.
  enum class Verdict { kUnseen, kTooFew, kMet, kMissed };

  int samples = 0;
  int seen = 0;     ///< number of samples in which the recording at least halved the prior's sigma
  int covered = 0;  ///< number of these samples with the truth inside the stated 95 % interval
  int covered_of_all = 0;
  double median_error = 0.0;  ///< median of |value / truth − 1| where seen; NaN: never seen
  double median_sigma = 0.0;  ///< median of the stated σ of the logarithm where seen; NaN: never seen

  /// Coverage covered / seen; NaN: never seen.
  double coverage() const;
  /// Clopper and Pearson's 95 % interval of coverage(). Throws base::InputError for a parameter that was
  /// never seen.
  stats::Interval coverageInterval() const;
  /// Verdict; kTooFew while the interval contains the goal.
  Verdict verdict() const;
};

inline constexpr double kCoverageGoal = 0.9;  ///< smallest coverage of a 95 % interval that is good enough

struct MonteCarloStudy {
  std::vector<std::string> names;        ///< r_l1, k_e2, …
  std::vector<RandomizedRobot> samples;  ///< finished ones, in order of their seeds
  std::vector<std::string> notices;
  bool cancelled = false;

  Recovery recovery(std::size_t parameter, experiments::Method method) const;
};

/// Runs the study. When cancelled, it contains the finished samples. Throws base::InputError for unusable
/// files and names.
MonteCarloStudy runMonteCarloStudy(const MonteCarloOptions& options, base::Progress& progress);

/// Table with one row per parameter and method.
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
