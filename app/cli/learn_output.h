#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/learning/evaluation/evaluate.h"
#include "core/learning/model/learn.h"

namespace capstan::cli {

/// Errors on tables that nothing was learned from.
struct TestReport {
  learning::PreparedStates prepared;
  learning::Evaluation errors;
};

struct LearnOutput {
  learning::LearningReport report;
  std::optional<TestReport> test;
  std::optional<learning::HeldOutEvaluation> held_out;
};

/// base::InputError: checkRelated() of the tables.
TestReport testedOn(const std::vector<learning::RawMotion>& motions, const learning::LearningReport& report,
                    const learning::LearningOptions& options);

std::string textOf(const LearnOutput& output);
nlohmann::json jsonOf(const LearnOutput& output);

}  // namespace capstan::cli
