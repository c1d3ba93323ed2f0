#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/search.h"

namespace capstan::diagnosis {

/// Effect of the selected set.
struct SelectedEffect {
  EffectCandidate effect;
  double probability = 0.0;  ///< sum of the posterior over all sets with the effect
  double loss = 0.0;         ///< held-out score lost without this effect alone [nats]
  BlockSquares without;      ///< held-out residuals of the selected set without the effect
};

/// Effects that explain the recordings about as well in the place of a selected one.
struct CompetingExplanations {
  EffectCandidate selected;
  std::vector<EffectCandidate> others;
  /// Relative probabilities: of the selected set, then of the set with each of `others`.
  std::vector<double> probabilities;
};

/// Effect of the most probable set that is not selected, because the set without it is probable enough
/// (kMinOddsWithout).
struct UncertainEffect {
  EffectCandidate effect;
  double probability = 0.0;  ///< that the effect is in the model
};

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
  Eigen::VectorXd input_noise;  ///< RMS per channel that noise of the inputs causes (inputNoise())
  Fit best;                     ///< fit with the selected effects
  BlockSquares best_squares;
  Weighting weighting;                             ///< weights of `best`
  std::vector<SelectedEffect> effects;             ///< effects with the largest loss first
  std::vector<UncertainEffect> uncertain;          ///< not selected (kMinOddsWithout)
  std::vector<CompetingExplanations> competitors;  ///< effects with competitors, in the same order
  std::vector<SetProbability> posterior;           ///< sets within kOccam, most probable first
  std::vector<ProbableSet> probable;               ///< the kProbableSets most probable sets, thinned
  std::vector<Candidate> candidates;               ///< candidates that the search tested
};

/// Searches sets of effects (search.h) and computes their posterior. The posterior is averaged over block
/// bootstraps (bagged posterior, Huggins and Miller 2023), because none of the models is exactly right:
///     p(S) = mean over draws d of  exp(L_d(S)) π(S) / Σ_S' exp(L_d(S')) π(S').
/// `start`: effects that another selection of the same recordings chose; null: none.
Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                 const Selection* start, const SearchOptions& options, base::Progress* progress);
/// Smallest ratio of the probability of a reported set to that of the best set (Occam's window, Madigan and
/// Raftery 1994).
inline constexpr double kOccam = 1e-3;
/// Smallest share p / (p + p_selected) of the probability at which a set that differs from the selected one
/// by one exchange makes a tie.
inline constexpr double kTie = 0.2;
/// An effect is not selected if the probability of the set without it is at least this multiple of that of
/// the most probable set: at odds of less than 2 to 1 the recordings do not decide.
inline constexpr double kMinOddsWithout = 0.5;
inline constexpr std::size_t kProbableSets = 4;

}  // namespace capstan::diagnosis
