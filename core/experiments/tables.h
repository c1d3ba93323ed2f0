#pragma once

#include <string>
#include <vector>

#include "core/base/table.h"
#include "core/experiments/published.h"
#include "core/experiments/results.h"

/// The UKF paper's tables from results, in deg, deg, mm; the paper's own numbers beside them where
/// `published` is given.
namespace capstan::experiments {

/// RMS errors of several trials, one estimator against another (UKF paper, table II).
struct Improvement {
  double mean = kNone, mean_before = kNone;
  double percent = kNone;  ///< 100 (mean_before − mean) / mean_before
  /// P of equal means, two-sided: Student's pooled t-test, which is the paper's, and Welch's; NaN for fewer
  /// than two trials or where nothing spreads.
  double p_pooled = kNone, p_welch = kNone;
};
Improvement improvementOf(const std::vector<double>& before, const std::vector<double>& after);
/// Of joint 0…2 over the trials of `results` that have a reference [deg, deg, mm].
Improvement improvementOf(const Results& results, Estimator before, Estimator after, int joint);

/// SI to deg, deg, mm.
double forPeople(double value, int joint);
/// "1 [deg]".
std::string jointName(int joint);

/// An experiment of the UKF paper: named A to D, with the work and the trials (but for names and seeds) of
/// resources/experiments.
bool isPapers(const Results& results);
/// `published` where the paper made the same experiment and gives numbers (A, C), else null.
const Published* paperBeside(const Results& results, const Published& published);

/// Table I: a row for each trial and joint. Kinematics of the identified robot only where it is not the
/// nominal one.
base::Table trialTable(const Results& results, const Published* published);
/// Table II: a row for each joint, over the trials that have joint encoders.
base::Table meanTable(const Results& results, const Published* published);
/// Identified parameters: where the methods began (nominal, or the robot of an identification before), truth,
/// both methods' value ± σ, whether the 95 % interval covers the truth, time to converge.
base::Table parameterTable(const Results& results, const Published* published);
/// RMS of the six-state and of the augmented filter, a row for each trial and joint.
base::Table filterTable(const Results& results);
/// Figure 13: quartiles, whiskers and outliers of |error| of the UKF, beside the median of the kinematics.
base::Table boxplotTable(const Results& results);

/// Every table of `results`, each with a name for its files.
struct NamedTable {
  std::string name;  ///< "table-1"
  base::Table table;
};
std::vector<NamedTable> tablesOf(const Results& results, const Published* published);
/// NAME.md, NAME.tex and NAME.csv of every table into `folder`. Throws base::InputError.
void writeTables(const std::vector<NamedTable>& tables, const std::filesystem::path& folder);

}  // namespace capstan::experiments
