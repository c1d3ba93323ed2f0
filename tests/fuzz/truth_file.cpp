#include "core/simulation/tool_truth.h"
#include "core/simulation/truth.h"
#include "tests/fuzz/fuzz_target.h"

CAPSTAN_FUZZ_TARGET(truth_file) {
  using namespace capstan;
  fuzz::allowInputError([&] {
    const std::string text =
        simulation::formatTruth(simulation::parseTruth(std::string(bytes), "truth.yaml"));
    fuzz::require(simulation::formatTruth(simulation::parseTruth(text, "again.yaml")) == text,
                  "a truth is read as it was written");
  });
  fuzz::allowInputError([&] { simulation::readToolTruth(fuzz::fileOf(bytes, "tool.yaml")); });
}
