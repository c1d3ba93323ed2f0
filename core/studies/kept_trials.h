#pragma once

#include <Eigen/Core>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/shard.h"
#include "core/experiments/trial_store.h"

namespace capstan::studies {

/// One trial of a study. Its result is JSON, so that a stored result and a new one are equal.
struct KeptTrial {
  std::string name;  ///< name of its file, unique within a study
  /// Returns all inputs that the result depends on.
  std::function<nlohmann::json()> fingerprint;
  std::function<nlohmann::json(base::Progress&)> run;
  double weight = 1.0;  ///< relative computing time
};

struct KeptResults {
  std::vector<nlohmann::json>
      results;  ///< one result per trial; null: cancelled before it was done, or not of the shard
  std::vector<std::string> notices;  ///< stored trials that were run again, and the reasons
  bool cancelled = false;
  bool shard = false;  ///< true: trials of other shards are not run, so there are no results of the study

  bool complete() const { return !cancelled && !shard; }
};

/// Reads the trials that `store` has and runs all others, `threads` at a time. Each result is stored at once,
/// so that an interrupted study continues where it stopped. With `part`, only its trials are run or read.
/// Throws what a trial throws, and base::InputError for a store that cannot be written.
KeptResults runKept(const std::vector<KeptTrial>& trials, const experiments::TrialStore& store, int threads,
                    base::Progress& progress, experiments::PartialRun* part = nullptr);

/// Number to JSON, null where it is not finite; and back, NaN from null.
nlohmann::json numberOrNull(double value);
double numberOrNan(const nlohmann::json& value);
/// The same for the entries of a vector.
nlohmann::json vectorOrNull(const Eigen::Vector3d& v);
Eigen::Vector3d vectorOrNan(const nlohmann::json& value);

}  // namespace capstan::studies
