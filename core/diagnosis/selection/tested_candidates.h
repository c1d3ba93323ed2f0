#pragma once

#include <vector>

#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/predictive_score.h"
#include "core/diagnosis/selection/screening.h"
#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

/// Candidates of one round of the search for the report, one per effect of `tests` in their order: what the
/// score tests of the set `parent` predict, and what the short fits `trials` with one more effect gain.
std::vector<Candidate> testedCandidates(const SetFit& parent, const std::vector<ScoreTest>& tests,
                                        const std::vector<SetFit>& trials, int round,
                                        const PredictiveScore& score);

}  // namespace capstan::diagnosis
