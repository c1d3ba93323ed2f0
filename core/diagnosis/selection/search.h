#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/set_fit.h"
#include "core/diagnosis/selection/set_prior.h"

namespace capstan::diagnosis {

struct SearchOptions {
  int most_causes = 6;  ///< largest number of effects in a set
  int refits = 8;  ///< number of candidates with the highest scores that are refitted per expansion of a set
  std::vector<std::string> only = {};  ///< names of hypotheses to consider; empty: all
  std::uint64_t seed = 1;              ///< seed of the block bootstraps
  double effort = 1.0;                 ///< multiplies kMostWork
  double progress_end = 0.65;          ///< value of the caller's progress at the end of the search
};

/// Result of searchSets().
struct SearchResult {
  EffectSet best;
  std::map<EffectSet, SetFit> sets;  ///< all tried sets; thinned except the best and the empty one
  ScoredChannels channels;           ///< what the sets are scored on
  SetPrior prior;                    ///< prior of the sets
  std::vector<Candidate> tested;     ///< tested candidates, in the order of the expansions
  bool complete = true;              ///< false: ended by kMostWork
};
/// Work of the simulations (FitData::work()) after which a search begins no further fits. It ends searches of
/// robots with many joints, whose sets have many neighbours. Of eight searches of planted recordings (group
/// choosing) six ended by themselves within about a quarter of it. Half of it changed what the axis of the
/// public benchmark was said to have (measured_diagnosis), four times as much did not.
inline constexpr double kMostWork = 2e9;

/// Best-first search over sets of effects. Sets are ordered by PredictiveScore plus SetPrior. The expansion
/// of a set tests every hypothesis on every joint with score tests and adds the most likely ones in short
/// refits; the best of these new sets are fitted until convergence. A set is not expanded if its residuals
/// exceed the sensors' noise by less than one more effect costs. A new best set is first fitted from the
/// nominal parameters and from other forms of its effects, too. The search expands the kBeam best sets (more
/// while residuals are far above the noise), until all of these are expanded. Then it expands the neighbours
/// of the best set: the sets with one effect less (exchange of one effect) and with two effects less (one
/// effect replaces two). The search ends when none of these leads to a better set, or after kMostWork.
/// `start`: a model whose effects are tried at the beginning; null: none.
SearchResult searchSets(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                        const Fit* start, const SearchOptions& options, base::Progress* progress);

}  // namespace capstan::diagnosis
