#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "core/base/names.h"
#include "core/base/progress.h"
#include "core/experiments/debridement_study.h"
#include "core/experiments/tables.h"
#include "core/learning/evaluation/correction_study.h"
#include "core/learning/evaluation/learning_curve.h"

/// The experiments of the GPR paper, beside its published numbers.
namespace capstan::experiments {

enum class CorrectionExperiment {
  kErrors,        ///< E: table I, errors of corrected poses, from tables of tip poses
  kTrainingSize,  ///< F: section V-B 2 and figure 5, errors by number of training states, from tables of tip
                  ///< poses
  kArrival,       ///< G: table II, arrival at fragments, with the simulated seven-joint arm
  kDebridement    ///< H: section V-D, debridement, with the simulated seven-joint arm
};

/// True for an experiment on tables of tip poses; false for a simulated one.
bool needsPoses(CorrectionExperiment experiment);

struct CorrectionExperimentOptions {
  CorrectionExperiment experiment = CorrectionExperiment::kErrors;
  std::vector<std::string> poses;                                 ///< tables of tip poses, for E and F
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< stream that is the target, for E and F
  learning::CorrectionStudyOptions errors;                        ///< options of E
  learning::LearningCurveOptions training_size;                   ///< options of F
  DebridementStudyOptions simulated;                              ///< options of G and H
};

struct CorrectionExperimentResults {
  CorrectionExperiment experiment = CorrectionExperiment::kErrors;
  std::string setting = {};  ///< sentences on the measurement and its differences from the paper
  std::vector<NamedTable> tables = {};
  std::variant<learning::CorrectionStudyReport, learning::LearningCurve, DebridementStudyReport> found = {};
  bool cancelled = false;
};

/// Runs one experiment. The same options give the same results with any number of threads. Throws
/// base::InputError when E or F has no table of tip poses, when G or H has one, and as readPoseTables(),
/// learningStages() and the studies do.
CorrectionExperimentResults runCorrectionExperiment(const CorrectionExperimentOptions& options,
                                                    base::Progress& progress);

/// Returns a Markdown page: title, setting, tables beside the paper's numbers, version.
std::string comparisonPage(const CorrectionExperimentResults& results, const std::string& software);
/// Numbers of the results, SI. E: {"clean", "all"} by method; F: {"points", "offset"}; G: {"training",
/// "arrival"} by mode; H: {"training", "methods", "beyond"} by method.
nlohmann::json jsonOf(const CorrectionExperimentResults& results);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::CorrectionExperiment> {
  using E = capstan::experiments::CorrectionExperiment;
  static constexpr std::array value = {std::pair{E::kErrors, "E"}, std::pair{E::kTrainingSize, "F"},
                                       std::pair{E::kArrival, "G"}, std::pair{E::kDebridement, "H"}};
};
