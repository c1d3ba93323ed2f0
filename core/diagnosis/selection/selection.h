#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/fit/input_noise.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/search.h"

namespace capstan::diagnosis {

using SelectedEffect = SelectedOf<EffectCandidate>;
using CompetingExplanations = CompetitorsOf<EffectCandidate>;
using UncertainEffect = UncertainOf<EffectCandidate>;

/// One set of the posterior, with its fit.
struct ProbableSet {
  SetFit set;
  double probability = 0.0;
};

/// Selected effects: those of the set with the highest posterior probability, except the uncertain ones. Also
/// the probabilities of other sets.
struct Selection {
  Fit base;  ///< fit of the nominal robot without effects
  BlockSquares base_squares;
  InputNoise input_noise;   ///< inputNoise() of the nominal structure
  InputNoise torque_noise;  ///< torqueNoise() of the selected model
  Fit best;                 ///< fit with the selected effects
  BlockSquares best_squares;
  Weighting weighting;                             ///< weights of `best`
  std::vector<SelectedEffect> effects;             ///< effects with the largest loss first
  std::vector<UncertainEffect> uncertain;          ///< not selected (kMinOddsWithout)
  std::vector<CompetingExplanations> competitors;  ///< effects with competitors, in the same order
  std::vector<SetProbability> posterior;           ///< sets within kOccam, most probable first
  std::vector<ProbableSet> probable;               ///< the kProbableSets most probable sets, thinned
  std::vector<Candidate> candidates;               ///< candidates that the search tested
  bool complete = true;                            ///< false: the search ended at its limit (kMostWork)
};

/// Searches sets of effects (search.h) and selects one of them (posterior.h). `start`: effects that another
/// selection of the same recordings chose; null: none.
Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                 const Selection* start, const SearchOptions& options, base::Progress* progress);
inline constexpr std::size_t kProbableSets = 4;

}  // namespace capstan::diagnosis
