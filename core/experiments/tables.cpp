#include "core/experiments/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/experiments/identified.h"
#include "core/experiments/trial_robots.h"
#include "core/stats/boxplot.h"
#include "core/stats/quantile.h"
#include "core/stats/rms.h"
#include "core/stats/t_test.h"

namespace capstan::experiments {
namespace {

using base::NumberStyle;
using base::Table;
using base::TableCell;

bool hasErrors(const TrialResult& trial) {
  return trial.counts[static_cast<std::size_t>(Estimator::kUkf)] > 0;
}

/// Definition of the trial without seed and name.
std::string textOf(TrialSpec trial) {
  trial.name.clear();
  trial.seed = 0;
  return base::writeYaml(trial);
}

/// "Experiment C", or the title of a run that is not an experiment.
std::string nameOf(const Results& results) {
  const bool run = !results.trials.empty() && !results.trials.front().filter_robot.empty();
  return run ? results.title : "Experiment " + results.name;
}

double countOf(const TrialResult& trial, Estimator which) {
  return static_cast<double>(trial.counts[static_cast<std::size_t>(which)]);
}

double rmsForPeople(const TrialResult& trial, Estimator which, int joint) {
  return forPeople(trial.rmsOf(which)(joint), joint);
}

/// The paper's table I is shown beside six trials only.
const Published* beside(const Results& results, const Published* published) {
  return published && results.trials.size() == published->table_1.duration.size() ? published : nullptr;
}

/// True when the estimator assumed another robot than the nominal one, so that their kinematics differ.
bool anotherRobot(const Results& results) {
  return std::any_of(results.trials.begin(), results.trials.end(), [](const TrialResult& trial) {
    const Eigen::Vector3d& identified = trial.rmsOf(Estimator::kIdentified);
    return identified.allFinite() && identified != trial.rmsOf(Estimator::kKinematic);
  });
}

template <class Test>
double pOf(Test&& test, const std::vector<double>& first, const std::vector<double>& second) {
  try {
    return test(first, second).p_value;
  } catch (const base::InputError&) {
    return kNone;  // too few trials, or no spread
  }
}

std::string value(const ParameterEstimate& estimate, double scale) {
  if (!estimate.seen) return "not observable";
  return fmt::format("{:.5g} ± {:.2g}", scale * estimate.value, scale * estimate.sigma);
}

double errorPercent(const ParameterEstimate& estimate, double truth) {
  return estimate.seen ? 100.0 * (estimate.value / truth - 1.0) : kNone;
}

TableCell covers(const ParameterEstimate& estimate, double truth) {
  if (!estimate.seen || !std::isfinite(truth)) return {};
  return estimate.low <= truth && truth <= estimate.high ? "yes" : "no";
}

/// True when a reference is the robot's own kinematics: the numbers are then differences from it.
bool againstOwnKinematics(const Results& results) {
  return std::any_of(results.trials.begin(), results.trials.end(),
                     [](const TrialResult& trial) { return trial.own_kinematics; });
}

std::string rmsName(const Results& results) {
  return againstOwnKinematics(results) ? "RMS differences from the robot's own kinematics" : "RMS errors";
}

std::string ownNote(const Results& results) {
  return againstOwnKinematics(results)
             ? "The reference is the robot's own kinematics: it cannot show which estimate is right. "
             : "";
}

/// "Means over 6 trials; P of equal means, two-sided. " Trials without joint encoders are not counted.
std::string meansNote(const Results& results) {
  const auto with = std::count_if(results.trials.begin(), results.trials.end(), hasErrors);
  const auto without = results.trials.size() - static_cast<std::size_t>(with);
  std::string text = fmt::format("Means over {} {}", with, with == 1 ? "trial" : "trials");
  if (without > 0) text += fmt::format(", {} without joint encoders excluded", without);
  return text + (with > 1 && !againstOwnKinematics(results) ? "; P of equal means, two-sided. " : ". ");
}

std::string simulatedNote(const Results& results) {
  return results.simulated ? "The robot is simulated." : "";
}

/// True when the methods started from the nominal robot, not from one that was identified before.
bool startsNominal(const Results& results) {
  return !results.identification ||
         results.identification->inputs.robot == results.identification->inputs.nominal;
}

std::string startNote(const Results& results) {
  if (startsNominal(results)) return {};
  std::string from;
  try {
    for (const std::string& name : parseSpecification(results.specification, results.name).robot)
      from += (from.empty() ? "" : ", ") + name;
  } catch (const base::InputError&) {
    // of another version of this program: unknown
  }
  return fmt::format("Start: where both methods began, the robot of {}. ",
                     from.empty() ? "an identification before" : from);
}

/// Text for a method without estimates.
std::string endNote(const IdentificationResult& result) {
  std::string text;
  if (!foundSomething(result.dual_end)) text += fmt::format("Dual UKF: {}. ", result.dual_end);
  if (!foundSomething(result.batch_end)) text += fmt::format("Batch: {}. ", result.batch_end);
  return text;
}

/// True when a true value is known, as in a simulation.
bool knowsTruth(const Results& results) {
  const auto known = [](const IdentifiedParameter& p) { return std::isfinite(p.truth); };
  return results.identification && std::any_of(results.identification->parameters.begin(),
                                               results.identification->parameters.end(), known);
}

std::vector<TableCell> parameterRow(const IdentifiedParameter& p, const Published* published, bool truth) {
  const bool in_paper = published && p.name == "r_l1";
  std::vector<TableCell> row = {fmt::format("{} [{}]", p.name, p.unit), p.scale * p.nominal};
  if (truth) row.push_back(p.scale * p.truth);
  if (published) row.push_back(in_paper ? published->radius.identified_mm : kNone);
  for (const ParameterEstimate* estimate : {&p.dual_ukf, &p.batch}) {
    row.push_back(value(*estimate, p.scale));
    if (!truth) continue;
    row.push_back(errorPercent(*estimate, p.truth));
    row.push_back(covers(*estimate, p.truth));
  }
  row.push_back(p.settled_at.value_or(kNone));
  if (published) row.push_back(in_paper ? published->radius.converged_after : kNone);
  return row;
}

}  // namespace

bool isPapers(const Results& results) {
  constexpr std::array kNames = {"A", "B", "C", "D"};
  if (std::find(kNames.begin(), kNames.end(), results.name) == kNames.end() || results.specification.empty())
    return false;
  try {
    const Specification paper = findSpecification(results.name);
    const Specification ours = parseSpecification(results.specification, paper.file);
    return ours.work == paper.work && ours.trials.size() == paper.trials.size() &&
           std::equal(ours.trials.begin(), ours.trials.end(), paper.trials.begin(),
                      [](const TrialSpec& a, const TrialSpec& b) { return textOf(a) == textOf(b); });
  } catch (const base::InputError&) {
    return false;  // of another version of this program
  }
}

const Published* paperBeside(const Results& results, const Published& published) {
  return isPapers(results) && (results.name == "A" || results.name == "C") ? &published : nullptr;
}

std::string jointName(int joint) {
  return fmt::format("{} [{}]", joint + 1, tracking::kJointUnits[static_cast<std::size_t>(joint)]);
}

Improvement improvementOf(const std::vector<double>& before, const std::vector<double>& after) {
  Improvement result;
  if (before.empty() || after.empty()) return result;
  result.mean = stats::mean(after);
  result.mean_before = stats::mean(before);
  result.percent = 100.0 * (result.mean_before - result.mean) / result.mean_before;
  result.p_pooled = pOf([](const auto& a, const auto& b) { return stats::pooledTTest(a, b); }, before, after);
  result.p_welch = pOf([](const auto& a, const auto& b) { return stats::welchTTest(a, b); }, before, after);
  return result;
}

Improvement improvementOf(const Results& results, Estimator before, Estimator after, int joint) {
  std::vector<double> first, second;
  for (const TrialResult& trial : results.trials) {
    if (!hasErrors(trial)) continue;
    first.push_back(rmsForPeople(trial, before, joint));
    second.push_back(rmsForPeople(trial, after, joint));
  }
  return improvementOf(first, second);
}

Table trialTable(const Results& results, const Published* published) {
  published = beside(results, published);
  Table table;
  table.title = nameOf(results) + ": " + rmsName(results) + " by trial";
  table.columns = {{"trial", "", 3, NumberStyle::kFixed, true},
                   {"duration", "s", 0, NumberStyle::kFixed, true},
                   {"joint", ""}};
  if (published) table.columns.push_back({"kinematic, paper", ""});
  table.columns.push_back({"kinematic", ""});
  if (published) table.columns.push_back({"UKF, paper", ""});
  for (const char* name : {"UKF", "camera"}) table.columns.push_back({name, ""});
  const bool identified = anotherRobot(results);
  if (identified) table.columns.push_back({"kinematic, identified robot", ""});
  table.columns.push_back({"n", "", 0});
  for (std::size_t i = 0; i < results.trials.size(); ++i) {
    const TrialResult& trial = results.trials[i];
    for (int joint = 0; joint < 3; ++joint) {
      std::vector<TableCell> row = {trial.name, trial.duration(), jointName(joint)};
      if (published) row.push_back(publishedScale(joint) * published->table_1.joint(joint).kinematic[i]);
      row.push_back(rmsForPeople(trial, Estimator::kKinematic, joint));
      if (published) row.push_back(publishedScale(joint) * published->table_1.joint(joint).ukf[i]);
      for (const Estimator which : {Estimator::kUkf, Estimator::kCamera})
        row.push_back(rmsForPeople(trial, which, joint));
      if (identified) row.push_back(rmsForPeople(trial, Estimator::kIdentified, joint));
      row.push_back(countOf(trial, Estimator::kUkf));
      table.rows.push_back(std::move(row));
    }
  }
  table.note = "RMS over all n reference samples; camera: over accepted images. " + ownNote(results) +
               robotNote(results) + simulatedNote(results);
  return table;
}

Table meanTable(const Results& results, const Published* published) {
  published = beside(results, published);
  Table table;
  const bool differences = againstOwnKinematics(results);  // nothing improves on its own reference
  table.title = nameOf(results) + ": mean " + rmsName(results) + (differences ? "" : " and improvement");
  table.columns = {{"joint", ""}};
  const auto column = [&](const char* name, const char* unit, int digits,
                          NumberStyle style = NumberStyle::kFixed) {
    if (published) table.columns.push_back({std::string(name) + ", paper", unit, digits, style});
    table.columns.push_back({name, unit, digits, style});
  };
  column("kinematic", "", 3);
  column("UKF", "", 3);
  if (!differences) {
    column("improvement", "%", 1);
    column("P, pooled", "", 2, NumberStyle::kSignificant);
    table.columns.push_back({"P, Welch", "", 2, NumberStyle::kSignificant});
  }
  const bool identified = !differences && anotherRobot(results);
  if (identified) table.columns.push_back({"improvement on identified kinematics", "%", 1});
  for (int joint = 0; joint < 3; ++joint) {
    const Improvement ours = improvementOf(results, Estimator::kKinematic, Estimator::kUkf, joint);
    const Improvement rest = improvementOf(results, Estimator::kIdentified, Estimator::kUkf, joint);
    const auto j = static_cast<std::size_t>(joint);
    std::vector<TableCell> row = {jointName(joint)};
    const auto pair = [&](double paper, double own) {
      if (published) row.push_back(paper);
      row.push_back(own);
    };
    const PublishedMeans paper = published ? published->table_2 : PublishedMeans{};
    pair(publishedScale(joint) * paper.kinematic[j], ours.mean_before);
    pair(publishedScale(joint) * paper.ukf[j], ours.mean);
    if (!differences) {
      pair(paper.improvement[j], ours.percent);
      pair(paper.p_value[j], ours.p_pooled);
      row.push_back(ours.p_welch);
    }
    if (identified) row.push_back(rest.percent);
    table.rows.push_back(std::move(row));
  }
  table.note = meansNote(results) + ownNote(results) + robotNote(results) +
               (identified ? "Identified kinematics: transmission kinematics of the identified robot, the "
                             "effect of calibration alone. "
                           : "") +
               simulatedNote(results);
  return table;
}

Table parameterTable(const Results& results, const Published* published) {
  Table table;
  table.title = nameOf(results) + ": identified parameters";
  const bool truth = knowsTruth(results);
  table.columns = {{"parameter", ""},
                   {startsNominal(results) ? "nominal" : "start", "", 5, NumberStyle::kSignificant}};
  if (truth) table.columns.push_back({"truth", "", 5, NumberStyle::kSignificant});
  if (published) table.columns.push_back({"paper", "", 5, NumberStyle::kSignificant});
  for (const std::string method : {"", "batch "}) {
    table.columns.push_back({method.empty() ? "dual UKF" : "batch", ""});
    if (!truth) continue;
    table.columns.push_back({method + "error", "%", 2});
    table.columns.push_back({method + "95 % covers truth", ""});
  }
  table.columns.push_back({"converged after", "s", 0});
  if (published) table.columns.push_back({"paper, converged", "s", 0});
  if (!results.identification) return table;
  for (const IdentifiedParameter& p : results.identification->parameters)
    table.rows.push_back(parameterRow(p, published, truth));
  table.note =
      "± is one standard deviation. Converged: time from which the dual UKF's standard deviation is below "
      "its "
      "goal and its value is steady. " +
      startNote(results) + endNote(*results.identification) + simulatedNote(results);
  return table;
}

Table boxplotTable(const Results& results) {
  Table table;
  table.title = nameOf(results) + (againstOwnKinematics(results)
                                       ? ": absolute differences of the UKF from the robot's own kinematics"
                                       : ": absolute errors of the UKF");
  table.columns = {{"trial", "", 3, NumberStyle::kFixed, true},
                   {"joint", ""},
                   {"median, kinematic", ""},
                   {"median", ""},
                   {"first quartile", ""},
                   {"third quartile", ""},
                   {"upper whisker", ""},
                   {"outliers", "%", 1},
                   {"RMS", ""},
                   {"occluded", "%", 1},
                   {"n", "", 0},
                   {"n of RMS", "", 0}};
  for (const TrialResult& trial : results.trials) {
    if (trial.errors.empty()) continue;
    for (int joint = 0; joint < 3; ++joint) {
      const stats::Boxplot box = stats::boxplot(trial.absoluteErrors(Estimator::kUkf, joint));
      const double kinematic = stats::median(trial.absoluteErrors(Estimator::kKinematic, joint));
      table.rows.push_back({trial.name, jointName(joint), forPeople(kinematic, joint),
                            forPeople(box.median, joint), forPeople(box.first_quartile, joint),
                            forPeople(box.third_quartile, joint), forPeople(box.upper_whisker, joint),
                            100.0 * static_cast<double>(box.outliers.size()) / static_cast<double>(box.n),
                            rmsForPeople(trial, Estimator::kUkf, joint), 100.0 * trial.occluded_share,
                            static_cast<double>(box.n), countOf(trial, Estimator::kUkf)});
    }
  }
  table.note = "Quartiles and outliers of n samples, RMS of all; whiskers reach 1.5 interquartile ranges. " +
               robotNote(results) + simulatedNote(results);
  return table;
}

/// True for experiments: they track with the six-state and with the augmented filter. An analysed recording
/// was tracked with one filter, which its options name.
bool ranBothFilters(const TrialResult& trial) { return trial.reference && trial.rms_augmented.allFinite(); }

Table filterTable(const Results& results) {
  Table table;
  table.title = nameOf(results) + ": six-state and augmented filter";
  table.columns = {{"trial", "", 3, NumberStyle::kFixed, true},
                   {"joint", ""},
                   {"kinematic", ""},
                   {"camera", ""},
                   {"UKF, six states", ""},
                   {"UKF, augmented", ""}};
  for (const TrialResult& trial : results.trials) {
    if (!ranBothFilters(trial)) continue;
    for (int joint = 0; joint < 3; ++joint)
      table.rows.push_back({trial.name, jointName(joint), rmsForPeople(trial, Estimator::kKinematic, joint),
                            rmsForPeople(trial, Estimator::kCamera, joint),
                            rmsForPeople(trial, Estimator::kUkf, joint),
                            forPeople(trial.rms_augmented(joint), joint)});
  }
  table.note =
      "RMS errors. The augmented filter estimates the six states and slow errors of the transmission. " +
      robotNote(results) + simulatedNote(results);
  return table;
}

std::vector<NamedTable> tablesOf(const Results& results, const Published* published) {
  if (results.work == Work::kIdentify) return {{"parameters", parameterTable(results, published)}};
  std::vector<NamedTable> tables = {{"trials", trialTable(results, published)},
                                    {"means", meanTable(results, published)}};
  if (std::any_of(results.trials.begin(), results.trials.end(), ranBothFilters))
    tables.push_back({"filters", filterTable(results)});
  tables.push_back({"boxplot", boxplotTable(results)});
  return tables;
}

void writeTables(const std::vector<NamedTable>& tables, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const NamedTable& one : tables) {
    base::writeTextFile(folder / (one.name + ".md"), base::markdownOf(one.table));
    base::writeTextFile(folder / (one.name + ".tex"), base::latexOf(one.table, "tab:" + one.name));
    base::writeTextFile(folder / (one.name + ".csv"), base::csvOf(one.table));
  }
}

}  // namespace capstan::experiments
