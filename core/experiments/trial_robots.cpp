#include "core/experiments/trial_robots.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/experiments/specification.h"
#include "core/robot/description.h"

namespace capstan::experiments {
namespace {

std::string nameIn(const std::string& robot) {
  if (robot.empty()) return {};
  try {
    return robot::parseDescription(robot, "robot of a trial").name;
  } catch (const base::InputError&) {
    return {};  // of another version of this program
  }
}

/// Robot that the specification gives the filter in place of the nominal one; empty: not known.
std::string believed(const Results& results) {
  try {
    const Specification specification = parseSpecification(results.specification, results.name);
    const std::string names = fmt::format("{}", fmt::join(specification.robot, ", "));
    return specification.robotIsFile() || names.empty() ? names : "as identified by " + names;
  } catch (const base::InputError&) {
    return {};
  }
}

}  // namespace

std::string kinematicRobotOf(const TrialResult& trial) {
  if (!trial.kinematic_robot.empty()) return trial.kinematic_robot;
  const std::string name = nameIn(trial.inputs.nominal);
  return name.empty() ? name : name + " (nominal)";
}

std::string filterRobotOf(const Results& results, const TrialResult& trial) {
  if (!trial.filter_robot.empty()) return trial.filter_robot;
  if (trial.inputs.robot == trial.inputs.nominal) return kinematicRobotOf(trial);
  const std::string name = nameIn(trial.inputs.robot), how = believed(results);
  return how.empty() ? name : fmt::format("{} ({})", name, how);
}

std::string robotWords(const std::string& kinematic_robot, const std::string& filter_robot) {
  if (filter_robot.empty()) return {};
  if (kinematic_robot == filter_robot) return fmt::format("kinematics and UKF of {}", filter_robot);
  return fmt::format("kinematics of {}, UKF of {}", kinematic_robot, filter_robot);
}

std::string robotNote(const Results& results) {
  const auto with = std::find_if(results.trials.begin(), results.trials.end(),
                                 [](const TrialResult& trial) { return !trial.errors.empty(); });
  if (with == results.trials.end()) return {};
  std::string words = robotWords(kinematicRobotOf(*with), filterRobotOf(results, *with));
  if (words.empty()) return {};
  words[0] = 'K';
  return words + ". ";
}

}  // namespace capstan::experiments
