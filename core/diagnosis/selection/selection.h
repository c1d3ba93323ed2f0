#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/search.h"

namespace capstan::diagnosis {

/// An effect of the selected set.
struct SelectedEffect {
  EffectCandidate effect;
  double probability = 0.0;  ///< that it belongs to the model: sum of the posterior over the sets that have it
  double loss = 0.0;         ///< score that is lost on held-out blocks when this effect alone is left out [nats]
  BlockSquares without;      ///< held-out residuals of the selected set without it
};

/// Effects that explain the recordings as well in the place of a selected one.
struct CompetingExplanations {
  EffectCandidate selected;
  std::vector<EffectCandidate> others;
  std::vector<double> probabilities;  ///< of the sets, relative to each other: of the selected one, then of the others
};

/// Selection of effects: the set with the highest posterior probability, and how firmly it is chosen.
struct Selection {
  Fit base;  ///< nominal structure, refitted
  BlockSquares base_squares;
  Eigen::VectorXd input_noise;  ///< RMS per channel that noise of the inputs brings in (inputNoise())
  Fit best;                     ///< with the selected effects
  BlockSquares best_squares;
  Weighting weighting;                           ///< of `best`
  std::vector<SelectedEffect> effects;           ///< the one with the largest loss first
  std::vector<CompetingExplanations> competitors;  ///< of effects that have such, in the same order
  std::vector<SetProbability> posterior;         ///< sets within kOccam of the best, the most probable first
  std::vector<Candidate> candidates;             ///< tested on the way
};

/// Searches sets of effects (search.h) and weighs them by their posterior. The posterior is averaged over block bootstraps
/// (bagged posterior, Huggins and Miller 2023), since no model of the set is exactly right:
///     p(S) = mean over draws d of  exp(L_d(S)) π(S) / Σ_S' exp(L_d(S')) π(S').
/// `start`: effects that another selection of the same recordings chose; null: none.
Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& nominal,
                 const Selection* start, const SearchOptions& options, base::Progress* progress);
/// Sets less probable than the best one by this factor are not reported (Occam's window, Madigan and Raftery 1994).
inline constexpr double kOccam = 1e-3;
/// Share of probability, of two sets that differ by an exchange, that makes them a tie.
inline constexpr double kTie = 0.2;

}  // namespace capstan::diagnosis
