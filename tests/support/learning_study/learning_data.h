#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/learning/model/learn.h"

/// Study of the GPR paper's results on a recording, compared with other programs.
namespace capstan::study {

struct LearningStudyOptions {
  std::string data, folder;
  int splits = 10;
  std::vector<std::string> towards = {"robot", "command"};  ///< streams of the table to learn towards
  std::uint64_t seed = 1;
  learning::CorrectionOptions correction;
};

/// States of one recording, with one stream as the target.
struct Target {
  learning::StreamKind towards = learning::StreamKind::kCommand;
  learning::ClockOffsetReport clock_offset;
  std::vector<learning::State> states;   ///< states with the clock offset removed
  std::vector<learning::State> as_told;  ///< states of the same motions with the original stamps
};

struct LearningData {
  Target command, robot;
};
LearningData readLearningData(const LearningStudyOptions& options);

/// Writes the numbers as lines with commas.
void writeNumbers(const std::filesystem::path& path, const Eigen::MatrixXd& numbers);

/// Output of sklearn_process.py for a folder; null if scikit-learn is missing.
nlohmann::json askSklearn(const std::filesystem::path& folder);

/// Empty folder for `part` of the study.
std::filesystem::path folderFor(const LearningStudyOptions& options, const std::string& part);

/// Standardised features (pose and velocity after the rigid offset) and scaled targets of a plain Gaussian
/// process.
struct PlainTable {
  Eigen::MatrixXd features, targets;
  Eigen::RowVectorXd scale;  ///< scale of the targets [m, rad]
};
struct PlainScales {
  learning::CorrectionParts parts;
  PlainTable of(const std::vector<learning::State>& states) const;
};
PlainScales plainScales(const std::vector<learning::State>& train);

}  // namespace capstan::study
