#include "core/diagnosis/selection/set_prior.h"

#include <cmath>

#include "core/diagnosis/selection/posterior.h"

namespace capstan::diagnosis {

double logPrior(const SetFit& set, int candidates, double instants) {
  return logPrior(set.effects, candidates, instants) + set.fit.model.logPrior(set.fit.u);
}

double logPrior(const EffectSet& effects, int candidates, double instants) {
  double prior = logPrior(effects.size(), candidates);
  for (const EffectCandidate& effect : effects)
    for (const robot::EffectParameter& parameter : effect.hypothesis->facts->parameters)
      if (isEventTime(parameter)) prior -= std::log(instants);
  return prior;
}

}  // namespace capstan::diagnosis
