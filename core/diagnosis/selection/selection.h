#pragma once

#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/fit/cross_validation.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

/// A model that was fitted, and how it does on held-out blocks.
struct CandidateModel {
  EffectCandidate added = {};  ///< to the model of the round; none for the base itself
  Fit fit;
  BlockSquares squares = {};
  std::vector<double> gain = {};  ///< Comparison::gain above the round's model
  Reduction reduction = {};       ///< on the round's model
  double share = 0.0;             ///< share of draws in which it is the best of its round
};

/// Effects that one recording cannot distinguish from the selected one.
struct CompetingExplanations {
  EffectCandidate taken;
  std::vector<EffectCandidate> others;
  std::vector<double> shares;  ///< of taken, then of the others
};

struct SelectionOptions {
  int most_causes = 4;
  int refits = 8;
  std::vector<std::string> only;
  std::uint64_t seed = 1;
  double progress_end = 0.95;  ///< of the caller's whole work, when the selection is done
};

struct Selection {
  Fit base;  ///< nominal structure, refitted
  BlockSquares base_squares = {};
  /// RMS of each channel that noise of the loads' and motors' sensors brings into it (inputNoise()).
  Eigen::VectorXd input_noise = {};
  Fit best;  ///< with the effects that were taken
  BlockSquares best_squares = {};
  Weighting weighting = {};                ///< of `best`
  std::vector<CandidateModel> taken = {};  ///< in the order in which they came
  std::vector<CompetingExplanations> competitors = {};
  std::vector<Candidate> candidates = {};  ///< of all rounds, for the report
};

/// What an effect must bring before it is named: a share of a channel's mean square, and a score that block
/// bootstraps leave above zero.
inline constexpr double kMaterial = 0.06;
inline constexpr double kLeastScore = 6.0;          ///< [nats]: against some hundred hypotheses
inline constexpr double kHighConfidence = 0.02;     ///< quantile of the bootstrap that must be above zero
inline constexpr double kMoreThanBackground = 1.2;  ///< times Hypothesis::background
inline constexpr double kClear = 3.0;               ///< σ of its own numbers together
/// Another effect ties with the best where it is the best in the share kCompetitor of bootstrap draws, or
/// scores the share kAsGood of the best. A competing explanation comes that close only where the motion does
/// not distinguish the two; their difference is then within the integration error of contacts and stiff
/// cables.
inline constexpr double kCompetitor = 0.08, kAsGood = 0.7;
/// It also ties where both remove the share kTakesMost of a residual and the rest differs by kSameResidual at
/// most.
inline constexpr double kTakesMost = 0.9, kSameResidual = 1.15;
/// Forward selection: each round has a score test of every hypothesis on every joint, refits of those with
/// the highest scores, and adds the best of them. Effects that later ones make superfluous are dropped.
Selection select(const FitData& data, const std::vector<Evidence>& recordings, const FitModel& base,
                 const SelectionOptions& options, base::Progress* progress);
/// The same on other data of the same recordings: starts with what `before` took, refitted, and drops what
/// these data do not need.
Selection selectFurther(const FitData& data, const std::vector<Evidence>& recordings, const Selection& before,
                        const SelectionOptions& options, base::Progress* progress);

}  // namespace capstan::diagnosis
