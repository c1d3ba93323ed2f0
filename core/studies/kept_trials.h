#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/experiments/trial_store.h"

namespace capstan::studies {

/// One trial of a study: its result is JSON, so that one that is kept and one that was just run are the same.
struct KeptTrial {
  std::string name;            ///< of its file; within a study no other has it
  nlohmann::json fingerprint;  ///< everything that the result depends on
  std::function<nlohmann::json(base::Progress&)> run;
  double weight = 1.0;  ///< how long it takes, in any unit
};

struct KeptResults {
  std::vector<nlohmann::json> results;  ///< a trial each; null: cancelled before it was done
  std::vector<std::string> notices;     ///< what was kept but had to be run again, and why
  bool cancelled = false;
};

/// Trials that `store` holds are read, all others run, `threads` at a time, and kept at once: an interrupted
/// study goes on where it stopped. Throws what a trial throws, and base::InputError for a store that cannot
/// be written.
KeptResults runKept(const std::vector<KeptTrial>& trials, const experiments::TrialStore& store, int threads,
                    base::Progress& progress);

/// A number as JSON writes it: null where it is not finite, and NaN back from null.
nlohmann::json numberOrNull(double value);
double numberOrNan(const nlohmann::json& value);

}  // namespace capstan::studies
