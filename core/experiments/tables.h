#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"
#include "core/experiments/published.h"
#include "core/experiments/results.h"

/// Tables of the UKF paper from results, in deg, deg, mm, with the paper's numbers beside them where
/// `published` is given.
namespace capstan::experiments {

/// Comparison of the RMS errors of two estimators over several trials (UKF paper, table II).
struct Improvement {
  double mean = kNone, mean_before = kNone;
  double percent = kNone;  ///< 100 (mean_before − mean) / mean_before
  /// Two-sided P of equal means: Student's pooled t-test, as in the paper, and Welch's t-test. NaN for fewer
  /// than two trials or zero spread.
  double p_pooled = kNone, p_welch = kNone;
};
Improvement improvementOf(const std::vector<double>& before, const std::vector<double>& after);
/// Improvement of joint 0…2 over the trials of `results` that have a reference [deg, deg, mm].
Improvement improvementOf(const Results& results, Estimator before, Estimator after, int joint);

using tracking::forPeople;
/// Name and unit of a joint: "1 [deg]".
std::string jointName(int joint);

/// True for an experiment of the UKF paper: named A to D, with the work and the trials of
/// resources/experiments (names and seeds may differ).
bool isPapers(const Results& results);
/// Returns `published` where the paper has numbers of the same experiment (A, C), else null.
const Published* paperBeside(const Results& results, const Published& published);

/// Table I: one row per trial and joint. It has kinematics of the identified robot only where that is not the
/// nominal one.
base::Table trialTable(const Results& results, const Published* published);
/// Table II: one row per joint, over the trials that have joint encoders.
base::Table meanTable(const Results& results, const Published* published);
/// Identified parameters: initial value (nominal, or of an earlier identification), truth, value ± σ of both
/// methods, whether the 95 % interval covers the truth, time to converge.
base::Table parameterTable(const Results& results, const Published* published);
/// RMS of the six-state and of the augmented filter, one row per trial and joint.
base::Table filterTable(const Results& results);
/// Figure 13: quartiles, whiskers and outliers of |error| of the UKF, beside the median of the kinematics.
base::Table boxplotTable(const Results& results);

/// A table and the name of its files.
struct NamedTable {
  std::string name;  ///< "table-1"
  base::Table table;
};
/// All tables of `results`.
std::vector<NamedTable> tablesOf(const Results& results, const Published* published);
/// Writes NAME.md, NAME.tex and NAME.csv of every table into `folder`. Throws base::InputError.
void writeTables(const std::vector<NamedTable>& tables, const std::filesystem::path& folder);

}  // namespace capstan::experiments
