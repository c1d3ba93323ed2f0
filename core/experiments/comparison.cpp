#include "core/experiments/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/error.h"
#include "core/experiments/tables.h"
#include "core/simulation/truth.h"

namespace capstan::experiments {
namespace {

constexpr double kRadiusGoal = 0.3, kStiffnessGoal = 5.0, kDampingGoal = 15.0;  // [%]
constexpr double kKinematicGoal = 15.0;                                         // [%]
constexpr double kOcclusionGoal = 1.10;

const Results* find(const std::vector<Results>& results, const std::string& name) {
  const auto found = std::find_if(results.begin(), results.end(),
                                  [&](const Results& one) { return one.name == name && isPapers(one); });
  return found == results.end() ? nullptr : &*found;
}

Verdict verdictOf(bool met) { return met ? Verdict::kMet : Verdict::kMissed; }

/// Text of the result on a parameter that is not known well: the advice of the method, or the convergence of
/// the dual UKF.
const std::string& wordsOf(const IdentifiedParameter& parameter, const ParameterEstimate& estimate) {
  return estimate.advice.empty() ? parameter.convergence : estimate.advice;
}

Goal parameterGoal(const IdentificationResult& result, const IdentifiedParameter& parameter, double percent) {
  const ParameterEstimate& estimate = result.chosen(parameter);
  Goal goal;
  goal.what =
      fmt::format("{} within {:g} % of the truth, or said to be not observable", parameter.name, percent);
  if (!estimate.seen) {
    goal.measured = "not observable: " + estimate.advice;
    goal.verdict = verdictOf(!estimate.advice.empty());
    return goal;
  }
  const double error = 100.0 * (estimate.value / parameter.truth - 1.0);
  const double sigma = 100.0 * estimate.sigma / estimate.value;
  goal.measured = fmt::format("{:+.2f} % ± {:.2f} %", error, sigma);
  goal.verdict = verdictOf(std::abs(error) <= percent);
  if (goal.verdict == Verdict::kMet) return goal;
  const std::string& words = wordsOf(parameter, estimate);
  if (!words.empty()) goal.measured += "; said of it: " + words;
  const bool inside = estimate.low <= parameter.truth && parameter.truth <= estimate.high;
  if (!words.empty() && sigma > percent && inside) goal.verdict = Verdict::kSaid;
  return goal;
}

/// Goal for the pulley radius. An experiment that starts from the identified robot of another one does not
/// have it.
void identificationGoals(const Results& results, std::vector<Goal>& goals) {
  if (!results.identification) return;
  const bool from_nominal = results.identification->inputs.robot == results.identification->inputs.nominal;
  for (const IdentifiedParameter& parameter : results.identification->parameters) {
    if (!std::isfinite(parameter.truth)) continue;
    const std::string kind = parameter.name.substr(0, 3);
    if (parameter.name == "r_l1" && from_nominal)
      goals.push_back(parameterGoal(*results.identification, parameter, kRadiusGoal));
    else if (kind == "k_e" || kind == "b_e")
      goals.push_back(
          parameterGoal(*results.identification, parameter, kind == "k_e" ? kStiffnessGoal : kDampingGoal));
  }
}

void errorGoals(const Results& results, const Published& published, std::vector<Goal>& goals) {
  for (int joint = 0; joint < 3; ++joint) {
    const Improvement ours = improvementOf(results, Estimator::kKinematic, Estimator::kUkf, joint);
    const auto j = static_cast<std::size_t>(joint);
    const double paper = publishedScale(joint) * published.table_2.kinematic[j];
    const double off = 100.0 * (ours.mean_before / paper - 1.0);
    goals.push_back({fmt::format("joint {}: mean kinematic error within {:g} % of the paper's {:.3f} {}",
                                 joint + 1, kKinematicGoal, paper, tracking::kJointUnits[j]),
                     fmt::format("{:.3f} {} ({:+.1f} %)", ours.mean_before, tracking::kJointUnits[j], off),
                     verdictOf(std::abs(off) <= kKinematicGoal)});
  }
  for (int joint = 0; joint < 3; ++joint) {
    const Improvement ours = improvementOf(results, Estimator::kKinematic, Estimator::kUkf, joint);
    const double paper = published.table_2.improvement[static_cast<std::size_t>(joint)];
    goals.push_back({fmt::format("joint {}: improvement over transmission kinematics better than the paper's "
                                 "{:.2f} %",
                                 joint + 1, paper),
                     fmt::format("{:.1f} %", ours.percent), verdictOf(ours.percent > paper)});
  }
}

void occlusionGoals(const Results& results, std::vector<Goal>& goals) {
  if (results.trials.size() < 2) return;
  const auto [least, most] = std::minmax_element(
      results.trials.begin(), results.trials.end(),
      [](const auto& a, const auto& b) { return a.occlusion.percentage < b.occlusion.percentage; });
  for (int joint = 0; joint < 3; ++joint) {
    const double ratio = most->rmsOf(Estimator::kUkf)(joint) / least->rmsOf(Estimator::kUkf)(joint);
    goals.push_back(
        {fmt::format("joint {}: RMS at {:g} % occlusion at most {:.2f} times that at {:g} %", joint + 1,
                     most->occlusion.percentage, kOcclusionGoal, least->occlusion.percentage),
         fmt::format("{:.3f} times", ratio), verdictOf(ratio <= kOcclusionGoal)});
  }
}

/// Origin of a trial: "seed 101", or the recording; empty: not known.
std::string originOf(const TrialSpec& trial) {
  return trial.recording.empty() ? fmt::format("seed {}", trial.seed)
                                 : std::filesystem::path(trial.recording).filename().string();
}

std::string originOf(const TrialResult& trial) {
  return trial.simulated && trial.inputs.recording.empty() ? fmt::format("seed {}", trial.seed)
                                                           : trial.inputs.recording;
}

/// Name and origin of every trial.
std::string trialsOf(const Results& results) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& origin) {
    text += (text.empty() ? "" : ", ") + name + (origin.empty() ? "" : " (" + origin + ")");
  };
  for (const TrialResult& trial : results.trials) add(trial.name, originOf(trial));
  if (!results.identification) return text;
  try {  // an identification keeps the inputs of its first trial only
    for (const TrialSpec& trial : parseSpecification(results.specification, results.name).trials)
      add(trial.name, originOf(trial));
  } catch (const base::InputError&) {  // of another version of this program
    const IdentificationResult& found = *results.identification;
    for (const std::string& name : found.recordings)
      add(name, name != found.recordings.front()  ? std::string()
                : !found.inputs.recording.empty() ? found.inputs.recording
                                                  : fmt::format("seed {}", found.seed));
  }
  return text;
}

/// Name of the truth of a simulation; empty where there is none or it is not known.
std::string truthOf(const Results& results) {
  const TrialInputs* inputs = results.identification    ? &results.identification->inputs
                              : !results.trials.empty() ? &results.trials.front().inputs
                                                        : nullptr;
  if (!results.simulated || !inputs || inputs->truth.empty()) return {};
  return simulation::parseTruth(inputs->truth, "truth").name;
}

std::string originOf(const Results& results) {
  std::string text = "- " + results.name;
  if (!results.title.empty()) text += ": " + results.title;
  const std::string trials = trialsOf(results);
  if (!trials.empty()) text += "; " + trials;
  const std::string truth = truthOf(results);
  if (!truth.empty()) text += "; truth " + truth;
  return text + (results.software.empty() ? "" : "; " + results.software) + "\n";
}

/// Heading and first sentence of the page.
std::string headOf(const std::vector<Results>& results, bool paper) {
  std::string page =
      paper ? "# Experiments of the UKF paper: published values and ours\n\n" : "# Experiments\n\n";
  const auto simulated =
      std::count_if(results.begin(), results.end(), [](const Results& one) { return one.simulated; });
  if (simulated == 0) return page + "These results are of recordings.\n\n";
  if (simulated < std::ssize(results)) return page + "Some of these results are of recordings.\n\n";
  if (!paper)
    return page + "The robot of these results is simulated: errors of a real robot will be larger.\n\n";
  const bool laboratory = std::all_of(results.begin(), results.end(),
                                      [](const Results& one) { return truthOf(one) == "laboratory"; });
  if (!laboratory)
    return page +
           "The robot of these results is simulated: errors of a real robot will be larger; the paper's was "
           "a "
           "real RAVEN-II.\n\n";
  return page +
         "The robot of these results is simulated: it has hysteresis, Stribeck friction and camera errors "
         "that the estimator does not know, but the same geometry, so that errors of a real robot will "
         "be larger; the paper's was a real RAVEN-II.\n\n";
}

}  // namespace

std::vector<Goal> goalsOf(const std::vector<Results>& results, const Published& published) {
  std::vector<Goal> goals;
  for (const char* name : {"A", "B"})
    if (const Results* one = find(results, name)) identificationGoals(*one, goals);
  if (const Results* one = find(results, "C")) errorGoals(*one, published, goals);
  if (const Results* one = find(results, "D")) occlusionGoals(*one, goals);
  return goals;
}

base::Table goalTable(const std::vector<Goal>& goals) {
  base::Table table;
  table.title = "Goals";
  table.columns = {{"goal", ""}, {"measured", ""}, {"", ""}};
  for (const Goal& goal : goals)
    table.rows.push_back({goal.what, goal.measured, std::string(base::nameOf(goal.verdict))});
  return table;
}

std::string comparisonPage(const std::vector<Results>& results, const Published& published) {
  std::string page = headOf(results, std::any_of(results.begin(), results.end(), isPapers));
  const std::vector<Goal> goals = goalsOf(results, published);
  if (!goals.empty()) page += base::markdownOf(goalTable(goals)) + "\n";
  for (const Results& one : results)
    for (const NamedTable& table : tablesOf(one, paperBeside(one, published)))
      if (table.name != "boxplot" || one.name != "C" || !isPapers(one))  // figure 13 is of D
        page += base::markdownOf(table.table) + "\n";
  if (find(results, "B") || find(results, "D"))
    page +=
        "The paper gives figures 7 and 13 as drawings, so there are no published numbers for k_e, b_e and "
        "the "
        "medians under occlusion. ";
  if (std::any_of(results.begin(), results.end(), [](const Results& one) { return !one.trials.empty(); }))
    page += "Units are deg, deg, mm.";
  page += "\n\n### Where it comes from\n\n";
  for (const Results& one : results) page += originOf(one);
  return page;
}

}  // namespace capstan::experiments
