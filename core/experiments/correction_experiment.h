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
  kErrors,        ///< E: table I, errors of corrected poses, on a table of tip poses
  kTrainingSize,  ///< F: section V-B 2 and figure 5, errors by number of training states, likewise
  kArrival,       ///< G: table II, arrival at fragments, on the simulated seven-joint arm
  kDebridement    ///< H: section V-D, debridement, likewise
};

/// They need tables of tip poses; else they simulate.
bool needsPoses(CorrectionExperiment experiment);

struct CorrectionExperimentOptions {
  CorrectionExperiment experiment = CorrectionExperiment::kErrors;
  std::vector<std::string> poses;                                 ///< tables, of E and F
  learning::StreamKind towards = learning::StreamKind::kCommand;  ///< of E and F
  learning::CorrectionStudyOptions errors;                        ///< of E
  learning::LearningCurveOptions training_size;                   ///< of F
  DebridementStudyOptions simulated;                              ///< of G and H
};

struct CorrectionExperimentResults {
  CorrectionExperiment experiment = CorrectionExperiment::kErrors;
  std::string setting = {};  ///< what was measured how, and where that differs from the paper: sentences
  std::vector<NamedTable> tables = {};
  std::variant<learning::CorrectionStudyReport, learning::LearningCurve, DebridementStudyReport> found = {};
  bool cancelled = false;
};

/// Runs one experiment; the same options give the same results, whatever the threads. base::InputError: no
/// table of tip poses for E or F, or one for G or H; as readPoseTables(), learningStages() and the studies.
CorrectionExperimentResults runCorrectionExperiment(const CorrectionExperimentOptions& options,
                                                    base::Progress& progress);

/// One page, Markdown: title, setting, tables beside the paper's numbers, version.
std::string comparisonPage(const CorrectionExperimentResults& results, const std::string& software);
/// The numbers, SI. E: {"clean", "all"} by method; F: {"points", "offset"}; G: {"training", "arrival"} by
/// mode; H: {"training", "methods", "beyond"} by method.
nlohmann::json jsonOf(const CorrectionExperimentResults& results);

}  // namespace capstan::experiments

template <>
struct capstan::base::NamesOf<capstan::experiments::CorrectionExperiment> {
  using E = capstan::experiments::CorrectionExperiment;
  static constexpr std::array value = {std::pair{E::kErrors, "E"}, std::pair{E::kTrainingSize, "F"},
                                       std::pair{E::kArrival, "G"}, std::pair{E::kDebridement, "H"}};
};
