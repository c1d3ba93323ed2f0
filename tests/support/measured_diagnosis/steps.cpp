#include "tests/support/measured_diagnosis/steps.h"

#include <filesystem>

namespace capstan::measured {

robot::Description robotFile(const std::string& name) {
  return robot::readDescription(std::filesystem::path(CAPSTAN_SOURCE_DIR) / "tests" / "core" / "diagnosis" /
                                "data" / name);
}

std::vector<Step> stepsOf(const diagnosis::Selection& selection) {
  std::vector<Step> steps{{"nominal structure", {}, selection.base}};
  for (const diagnosis::CandidateModel& taken : selection.taken) {
    Step step{"+ " + std::string(taken.added.hypothesis->name()), {}, taken.fit};
    for (const diagnosis::CompetingExplanations& competitors : selection.competitors)
      if (competitors.taken.hypothesis == taken.added.hypothesis &&
          competitors.taken.joint == taken.added.joint)
        for (const diagnosis::EffectCandidate& other : competitors.others)
          step.competitors.emplace_back(other.hypothesis->name());
    steps.push_back(std::move(step));
  }
  if (!selection.taken.empty()) steps.back().fit = selection.best;
  return steps;
}

}  // namespace capstan::measured
