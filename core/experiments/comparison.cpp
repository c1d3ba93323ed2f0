#include "core/experiments/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/experiments/tables.h"

namespace capstan::experiments {
namespace {

constexpr double kRadiusGoal = 0.3, kStiffnessGoal = 5.0, kDampingGoal = 15.0;  // [%]
constexpr double kKinematicGoal = 15.0;                                         // [%]
constexpr double kOcclusionGoal = 1.10;

const Results* find(const std::vector<Results>& results, const std::string& name) {
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const Results& one) { return one.name == name; });
  return found == results.end() ? nullptr : &*found;
}

Goal parameterGoal(const IdentificationResult& result, const IdentifiedParameter& parameter, double percent) {
  const ParameterEstimate& estimate = result.chosen(parameter);
  Goal goal;
  goal.what =
      fmt::format("{} within {:g} % of the truth, or said to be out of sight", parameter.name, percent);
  if (!estimate.seen) {
    goal.measured = "not seen: " + estimate.advice;
    goal.met = !estimate.advice.empty();
    return goal;
  }
  const double error = 100.0 * (estimate.value / parameter.truth - 1.0);
  goal.measured = fmt::format("{:+.2f} % ± {:.2f} %", error, 100.0 * estimate.sigma / estimate.value);
  goal.met = std::abs(error) <= percent;
  if (!goal.met && !parameter.convergence.empty()) goal.measured += "; said of it: " + parameter.convergence;
  return goal;
}

void identificationGoals(const Results& results, std::vector<Goal>& goals) {
  if (!results.identification) return;
  for (const IdentifiedParameter& parameter : results.identification->parameters) {
    if (!std::isfinite(parameter.truth)) continue;
    const std::string kind = parameter.name.substr(0, 3);
    if (parameter.name == "r_l1")
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
                     std::abs(off) <= kKinematicGoal});
  }
  for (int joint = 0; joint < 3; ++joint) {
    const Improvement ours = improvementOf(results, Estimator::kKinematic, Estimator::kUkf, joint);
    const double paper = published.table_2.improvement[static_cast<std::size_t>(joint)];
    goals.push_back({fmt::format("joint {}: improvement over transmission kinematics better than the paper's "
                                 "{:.2f} %",
                                 joint + 1, paper),
                     fmt::format("{:.1f} %", ours.percent), ours.percent > paper});
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
         fmt::format("{:.3f} times", ratio), ratio <= kOcclusionGoal});
  }
}

std::string originOf(const Results& results) {
  std::string text = fmt::format("- {}: {}", results.name, results.title);
  std::string seeds;
  if (results.identification && results.simulated) seeds = std::to_string(results.identification->seed);
  for (const TrialResult& trial : results.trials)
    if (trial.simulated) seeds += (seeds.empty() ? "" : ", ") + std::to_string(trial.seed);
  if (!seeds.empty()) text += "; seeds " + seeds;
  if (std::isfinite(results.wall_seconds)) text += fmt::format("; wall time {:.1f} s", results.wall_seconds);
  return text + "; " + results.software + "\n";
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
    table.rows.push_back({goal.what, goal.measured, goal.met ? "met" : "not met"});
  return table;
}

std::string comparisonPage(const std::vector<Results>& results, const Published& published) {
  const bool simulated =
      std::all_of(results.begin(), results.end(), [](const Results& one) { return one.simulated; });
  std::string page = "# Experiments of the UKF paper: published values and ours\n\n";
  page +=
      simulated
          ? "The robot of these results is simulated: it has hysteresis, Stribeck friction and camera errors "
            "that the estimator does not know, but the same geometry, so that errors of a real robot will "
            "be larger; the paper's was a real RAVEN-II.\n\n"
          : "Some of these results are of recordings.\n\n";
  const std::vector<Goal> goals = goalsOf(results, published);
  if (!goals.empty()) page += base::markdownOf(goalTable(goals)) + "\n";
  for (const Results& one : results) {
    for (const NamedTable& table : tablesOf(one, paperBeside(one, published))) {
      const bool shown = one.name != "C" || table.name != "boxplot";
      if (shown) page += base::markdownOf(table.table) + "\n";
    }
  }
  page +=
      "The paper gives figures 7 and 13 as drawings: there are no numbers of it to put beside k_e, b_e and "
      "the medians under occlusion. Units are deg, deg, mm.\n\n### Where it comes from\n\n";
  for (const Results& one : results) page += originOf(one);
  return page;
}

}  // namespace capstan::experiments
