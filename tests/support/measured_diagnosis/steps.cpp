#include "tests/support/measured_diagnosis/steps.h"

#include "tests/support/folders.h"

namespace capstan::measured {

robot::Description robotFile(const std::string& name) {
  return robot::readDescription(test::sourceFile("tests/core/diagnosis/data/" + name));
}

std::vector<Step> stepsOf(const diagnosis::FitData& data, const diagnosis::Selection& selection) {
  std::vector<Step> steps{{"nominal structure", {}, selection.base}};
  const diagnosis::SetFitter fitter(data);
  const diagnosis::SetFit nominal{{}, selection.base, selection.weighting, {}, {}, true};
  diagnosis::EffectSet effects;
  for (const diagnosis::SelectedEffect& selected : selection.effects) {
    effects = plus(std::move(effects), selected.effect);
    Step step{"+ " + std::string(selected.effect.hypothesis->name()), {}, selection.best};
    if (effects.size() < selection.effects.size())
      step.fit = fitter.extended(nominal, effects, selection.best).fit;
    for (const diagnosis::CompetingExplanations& competing : selection.competitors)
      if (competing.selected == selected.effect)
        for (const diagnosis::EffectCandidate& other : competing.others)
          step.competitors.emplace_back(other.hypothesis->name());
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace capstan::measured
