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
#include "core/tracking/health.h"

namespace capstan::studies {

/// Options of the study of the estimator's health: sessions with a right filter and with one known fault
/// each, and the verdicts of tracking::healthOf() on them.
struct HealthStudyOptions {
  std::string truth = "default";  ///< see simulation::SimulationRequest::truth
  double duration = 60.0;         ///< of each session [s]
  std::uint64_t seed = 21;        ///< of the first session; the limits were chosen on seeds 1 to 10
  int sessions = 20;              ///< sessions per fault
  int threads = 2;                ///< number of worker threads; the result does not depend on it
  /// Folder of finished trials, which are not run again unless program, options or inputs changed; empty:
  /// none.
  std::filesystem::path out;
  std::string software = base::software();  ///< program that a stored trial must come from
  experiments::PartialRun* part = nullptr;  ///< trials that are run, if not all; needs `out`
};

/// Verdicts on the sessions with one fault.
struct HealthStudyCase {
  std::string fault;
  std::vector<std::string> expected;              ///< keys of the checks that name the fault
  std::array<int, 4> verdicts{};                  ///< sessions by tracking::HealthVerdict
  int named = 0;                                  ///< sessions in which an expected check does not pass
  int other = 0;                                  ///< sessions in which another check does not pass
  std::vector<std::string> others;                ///< keys of those checks
  Eigen::Vector3d nis_low, nis_high;              ///< smallest and largest mean NIS per joint
  Eigen::Vector3d rms = Eigen::Vector3d::Zero();  ///< RMS error of the filter over all sessions [rad, rad, m]
};

struct HealthStudy {
  std::vector<HealthStudyCase> cases;
  std::vector<std::string> notices;
  bool cancelled = false;
};

/// Runs the study. Deterministic and cancellable; cancelled: without cases.
HealthStudy runHealthStudy(const HealthStudyOptions& options, base::Progress& progress);

/// Table with one row per fault.
base::Table casesOf(const HealthStudy& study);

}  // namespace capstan::studies
