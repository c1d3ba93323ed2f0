#pragma once

#include <filesystem>

#include "core/base/table.h"
#include "core/experiments/arrival_study.h"
#include "core/experiments/debridement_task.h"
#include "core/stats/interval.h"

/// Section V of the GPR paper on the simulated seven-joint arm: training, then table II or debridement.
namespace capstan::experiments {

struct DebridementStudyOptions {
  std::filesystem::path robot;  ///< empty: robots/raven2_left_tool.yaml of the resources
  std::filesystem::path truth;  ///< empty: truth/debridement.yaml of the resources
  TrainingOptions training;
  ArrivalOptions arrival;
  DebridementTaskOptions task;
  /// Fragments of a second grid, beside the first one by this [m] on the side that the arm reaches, where the
  /// correction knows little.
  int fragments_beyond = 50;
  double beyond = 0.09;
  int threads = 2;         ///< for all of it; the result does not depend on it
  std::uint64_t seed = 1;  ///< of all of it
};

/// One method over all of its fragments.
struct DebridementSummary {
  int fragments = 0, grasped = 0, cleared = 0, refused = 0;
  double time = 0.0;              ///< mean of a fragment [s]
  stats::Interval time_interval;  ///< 95 %, by the normal distribution [s]
  double moving = 0.0;            ///< of it, on the way [s]
  double observations = 0.0;      ///< mean of a fragment
  double off = 0.0;               ///< mean of jaws from fragments when they closed [m]
  stats::Interval success;        ///< of cleared / fragments, 95 %, Wilson's
};

DebridementSummary summaryOf(const std::vector<FragmentRun>& runs);

/// Ratio of two means with its 95 % interval, by the delta method on its logarithm.
struct Speedup {
  double value = 0.0;
  stats::Interval interval;
};

struct DebridementStudyReport {
  std::size_t motions = 0, rows = 0, screened = 0, states = 0, kept = 0;  ///< as TrainedCorrection
  double clock_offset = 0.0;                                              ///< [s]
  ArrivalReport arrival{};
  std::array<std::vector<FragmentRun>, kDebridementMethods> runs, beyond;  ///< by method
  bool cancelled = false;                                                  ///< what was done by then is there

  DebridementSummary summary(DebridementMethod method) const {
    return summaryOf(runs[static_cast<std::size_t>(method)]);
  }
  /// Time a fragment of kReplanning over that of kCorrected. Nothing without two fragments of each.
  Speedup speedup() const;
};

/// Both train a correction first, from motions that are recorded on the arm. base::InputError: files or
/// options that are unusable.
DebridementStudyReport runArrival(const DebridementStudyOptions& options, base::Progress& progress);
DebridementStudyReport runDebridement(const DebridementStudyOptions& options, base::Progress& progress);

/// How the correction was learned.
base::Table trainingTable(const DebridementStudyReport& report);
/// Table II, ours beside the paper's.
base::Table arrivalTable(const DebridementStudyReport& report);
/// Time a fragment, success and speed-up beside the paper's.
base::Table debridementTable(const DebridementStudyReport& report, const DebridementStudyOptions& options);
/// The same beyond the data.
base::Table beyondTable(const DebridementStudyReport& report, const DebridementStudyOptions& options);

}  // namespace capstan::experiments
