#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/learning/model/learn.h"

/// The GPR paper's numbers on a recording, beside other programs'.
namespace capstan::study {

struct LearningStudyOptions {
  std::string data, folder;
  int splits = 10;
  std::vector<std::string> towards = {"robot", "command"};  ///< of the table
  std::uint64_t seed = 1;
  learning::CorrectionOptions correction;
};

/// States of one recording towards one stream.
struct Target {
  learning::StreamKind towards = learning::StreamKind::kCommand;
  learning::ClockOffsetReport clock_offset;
  std::vector<learning::State> states;   ///< the lag taken off
  std::vector<learning::State> as_told;  ///< of the same motions, stamps as they are
};

struct LearningData {
  Target command, robot;
};
LearningData readLearningData(const LearningStudyOptions& options);

/// Numbers as lines of commas.
void writeNumbers(const std::filesystem::path& path, const Eigen::MatrixXd& numbers);

/// What sklearn_process.py says of a folder; null where there is no scikit-learn.
nlohmann::json askSklearn(const std::filesystem::path& folder);

/// A folder for `part` of the study, empty.
std::filesystem::path folderFor(const LearningStudyOptions& options, const std::string& part);

/// Features in deviations and targets in scales as a plain process has them: pose and velocity after the
/// rigid offset.
struct PlainTable {
  Eigen::MatrixXd features, targets;
  Eigen::RowVectorXd scale;  ///< of the targets [m, rad]
};
struct PlainScales {
  learning::CorrectionParts parts;
  PlainTable of(const std::vector<learning::State>& states) const;
};
PlainScales plainScales(const std::vector<learning::State>& train);

}  // namespace capstan::study
