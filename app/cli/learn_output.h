#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/learning/evaluation/evaluate.h"
#include "core/learning/model/learn.h"

namespace capstan::cli {

/// Errors on the test tables, which are not part of the training.
struct TestReport {
  learning::PreparedStates prepared;
  learning::Evaluation errors;
};

/// Results of `capstan-cli learn`.
struct LearnOutput {
  learning::LearningReport report;
  std::optional<TestReport> test;
  std::optional<learning::HeldOutEvaluation> held_out;
};

/// Errors of the model on the test tables. Throws base::InputError if checkRelated() refuses the tables.
TestReport testedOn(const std::vector<learning::RawMotion>& motions, const learning::LearningReport& report,
                    const learning::LearningOptions& options);

std::string textOf(const LearnOutput& output);
nlohmann::json jsonOf(const LearnOutput& output);

}  // namespace capstan::cli
