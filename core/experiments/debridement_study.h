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
  int fragments_beyond = 50;  ///< number of fragments on a second grid, where the correction has few data
  double beyond = 0.09;       ///< distance of the second grid to the side that the arm reaches [m]
  int threads = 2;            ///< number of worker threads; the result does not depend on it
  std::uint64_t seed = 1;     ///< seed of all parts
};

/// Results of one method over all of its fragments.
struct DebridementSummary {
  int fragments = 0, grasped = 0, cleared = 0, refused = 0;
  double time = 0.0;              ///< mean time per fragment [s]
  stats::Interval time_interval;  ///< 95 % interval of the mean time, by the normal distribution [s]
  double moving = 0.0;            ///< mean time in motion per fragment [s]
  double observations = 0.0;      ///< mean number of observations per fragment
  double off = 0.0;               ///< mean distance of jaws and fragment when the jaws closed [m]
  stats::Interval success;        ///< Wilson's 95 % interval of cleared / fragments
};

DebridementSummary summaryOf(const std::vector<FragmentRun>& runs);

/// Ratio of two mean times with its 95 % interval, by the delta method on its logarithm.
struct Speedup {
  double value = 0.0;
  stats::Interval interval;
};

struct DebridementStudyReport {
  std::size_t motions = 0, rows = 0, screened = 0, states = 0, kept = 0;  ///< as TrainedCorrection
  double clock_offset = 0.0;                                              ///< [s]
  ArrivalReport arrival{};
  std::array<std::vector<FragmentRun>, kDebridementMethods> runs, beyond;  ///< runs on each grid, by method
  bool cancelled = false;  ///< true: only finished parts are filled

  DebridementSummary summary(DebridementMethod method) const {
    return summaryOf(runs[static_cast<std::size_t>(method)]);
  }
  /// Time per fragment of kReplanning / that of kCorrected; 0 with fewer than two fragments of either.
  Speedup speedup() const;
};

/// Run one study. Both train a correction first, from motions recorded on the arm. Throw base::InputError for
/// unusable files or options.
DebridementStudyReport runArrival(const DebridementStudyOptions& options, base::Progress& progress);
DebridementStudyReport runDebridement(const DebridementStudyOptions& options, base::Progress& progress);

/// Table of the correction's training data.
base::Table trainingTable(const DebridementStudyReport& report);
/// Table II beside the paper's numbers.
base::Table arrivalTable(const DebridementStudyReport& report);
/// Table of time per fragment, success and speed-up beside the paper's numbers.
base::Table debridementTable(const DebridementStudyReport& report, const DebridementStudyOptions& options);
/// The same table for the second grid, beyond the training data.
base::Table beyondTable(const DebridementStudyReport& report, const DebridementStudyOptions& options);

}  // namespace capstan::experiments
