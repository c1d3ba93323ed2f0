#include "core/diagnosis/selection/set_prior.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/selection/posterior.h"
#include "core/diagnosis/selection/screening.h"

namespace capstan::diagnosis {

SetPrior::SetPrior(const std::vector<Evidence>& recordings, int candidates) : candidates_(candidates) {
  for (const Evidence& evidence : recordings)
    instants_ = std::max(instants_, evidence.duration() / kEventStep);
}

double SetPrior::of(const EffectSet& effects) const {
  double prior = logPrior(effects.size(), candidates_);
  for (const EffectCandidate& effect : effects)
    if (std::ranges::any_of(effect.hypothesis->facts->parameters, isEventTime)) prior -= std::log(instants_);
  return prior;
}

double SetPrior::of(const SetFit& set) const { return of(set.effects) + set.fit.model.logPrior(set.fit.u); }

double SetPrior::costOfOneMore(std::size_t effects) const {
  return logPrior(effects, candidates_) - logPrior(effects + 1, candidates_);
}

}  // namespace capstan::diagnosis
