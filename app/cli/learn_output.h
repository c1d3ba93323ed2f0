#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/learning/evaluation/correction_errors.h"
#include "core/learning/model/learn.h"

namespace capstan::cli {

/// Distances [m] and geodesic angles [rad] on one set of states: nothing corrected, by the offset, by the
/// model.
struct TestedStates {
  std::size_t states = 0;
  learning::CorrectionErrors none, offset, corrected;
};

struct TestReport {
  learning::PreparedStates prepared;
  TestedStates all, clean;  ///< clean: those that the training data's limits keep
};

struct LearnOutput {
  const learning::LearningReport& report;
  std::optional<TestReport> test;
};

/// base::InputError: checkRelated() of the tables.
TestReport testedOn(const std::vector<learning::RawMotion>& motions, const learning::LearningReport& report,
                    const learning::LearningOptions& options);

std::string textOf(const LearnOutput& output);
nlohmann::json jsonOf(const LearnOutput& output);

}  // namespace capstan::cli
