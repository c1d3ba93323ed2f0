#include "core/diagnosis/selection/set_prior.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

SetPrior::SetPrior(const std::vector<Evidence>& recordings, const std::vector<JointScales>& scales,
                   int candidates)
    : candidates_(candidates) {
  double instants = 1.0;  // that score tests try
  for (const Evidence& evidence : recordings) instants = std::max(instants, evidence.duration() / kEventStep);
  const int joints = static_cast<int>(scales.size());
  for (const Hypothesis& hypothesis : hypotheses()) {
    const bool once = std::ranges::any_of(hypothesis.facts->parameters, isEventTime);
    const bool whole = hypothesis.facts->whole;
    for (int joint = whole ? 0 : 1; joint <= (whole ? 0 : joints); ++joint)
      log_forms_[{&hypothesis, joint}] =
          std::log(once ? instants : hypothesis.forms(scalesOf(scales, joint), joint));
  }
}

double SetPrior::of(const EffectSet& effects) const {
  double prior = logPrior(effects.size(), candidates_);
  for (const EffectCandidate& effect : effects) prior -= log_forms_.at(effect);
  return prior;
}

double SetPrior::of(const SetFit& set) const { return of(set.effects) + set.fit.model.logPrior(set.fit.u); }

double SetPrior::costOfOneMore(std::size_t effects) const {
  return logPrior(effects, candidates_) - logPrior(effects + 1, candidates_);
}

}  // namespace capstan::diagnosis
