#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/predictive_score.h"
#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

struct SearchOptions {
  int most_causes = 6;  ///< largest set
  int refits = 8;       ///< candidates with the highest score tests that are refitted where a set is expanded
  std::vector<std::string> only = {};  ///< names of hypotheses to consider; empty: all
  std::uint64_t seed = 1;              ///< of the block bootstraps
  double progress_end = 0.95;          ///< fraction of the caller's whole work when the search is done
};

/// The sets that were tried, and the candidates that were tested on the way.
struct SearchResult {
  EffectSet best;
  std::map<EffectSet, SetFit> sets;  ///< the best one and the nominal structure (empty set) not thinned
  Eigen::VectorXd input_noise;       ///< RMS per channel that noise of the inputs brings in
  int candidates = 0;                ///< effects that this robot and these sensors can have
  std::vector<Candidate> tested;     ///< in the order of the expansions
};

/// Best-first search over sets of effects. A set is expanded by score tests of every hypothesis on every joint and short refits
/// of the most likely ones, and by the removal of each of its effects; the best of these are fitted to the end. Each time, the
/// kBeam best sets that are not expanded yet are. When none is left, the neighbours of the best set are expanded: the sets with
/// one effect less, from which one is exchanged for another, and those with two less, from which one replaces two. The search
/// ends when none of these is better. Sets are ordered by PredictiveScore plus logPrior().
/// `start`: a model whose effects are tried from the begin, as well; null: none.
SearchResult searchSets(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                        const Fit* start, const SearchOptions& options, base::Progress* progress);

/// Log prior of a set of `effects` out of `candidates` [nats]: every set of a size is equally probable, and each further effect
/// has the odds kEffectOdds.
double logPrior(std::size_t effects, int candidates);
inline constexpr double kEffectOdds = 0.25;
inline constexpr int kDraws = 400;  ///< block bootstraps

}  // namespace capstan::diagnosis
