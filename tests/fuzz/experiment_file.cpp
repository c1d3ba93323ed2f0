#include "core/experiments/specification.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(experiment_file) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const auto specification = experiments::parseSpecification(std::string(bytes), "experiment.yaml");
    fuzz::require(!specification.trials.empty(), "an experiment has a trial");
    for (const experiments::TrialSpec& trial : specification.trials) {
      specification.resolved(trial.recording);
      fuzz::require(specification.lineOf(trial.name, "name") > 0, "a trial has a line");
    }
    specification.needs();
  });
}
