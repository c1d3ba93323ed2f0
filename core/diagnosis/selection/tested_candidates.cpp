#include "core/diagnosis/selection/tested_candidates.h"

#include <limits>
#include <set>

namespace capstan::diagnosis {

std::vector<Candidate> testedCandidates(const SetFit& parent, const std::vector<ScoreTest>& tests,
                                        const std::vector<SetFit>& trials, int round,
                                        const PredictiveScore& score) {
  std::vector<Candidate> candidates;
  std::set<EffectSet> tested;
  for (const ScoreTest& test : tests) {
    const EffectSet with = plus(parent.effects, {test.hypothesis, test.joint});
    if (!tested.insert(with).second) continue;  // another form of it
    Candidate candidate{.effect = std::string(test.hypothesis->name()),
                        .joint = test.joint,
                        .round = round,
                        .screened = test.share,
                        .refitted = false,
                        .reduction = std::numeric_limits<double>::quiet_NaN(),
                        .score = std::numeric_limits<double>::quiet_NaN(),
                        .probability = 0.0};
    for (const SetFit& trial : trials) {
      if (trial.effects != with || trial.fitted.sum.size() == 0) continue;
      candidate.refitted = true;
      candidate.reduction = largestReduction(parent.fitted, trial.fitted).share;
      candidate.score = score.of(trial.fitted) - score.of(parent.fitted);
    }
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace capstan::diagnosis
