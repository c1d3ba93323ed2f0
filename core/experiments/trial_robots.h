#pragma once

#include <string>

#include "core/experiments/results.h"

/// The robots that a trial's numbers are of, by name.
namespace capstan::experiments {

/// Whose transmission kinematics the trial's kinematic errors are: "RAVEN-II left (nominal)"; empty: not
/// known.
std::string kinematicRobotOf(const TrialResult& trial);
/// That the filter assumed: the nominal one, a robot file, or "RAVEN-II left as identified by A, B".
std::string filterRobotOf(const Results& results, const TrialResult& trial);
/// "kinematics and UKF of RAVEN-II left", "kinematics of nominal.yaml, UKF of mine.yaml"; empty: not known.
std::string robotWords(const std::string& kinematic_robot, const std::string& filter_robot);

/// robotWords() of the first trial with errors, and a full stop; empty: not known.
std::string robotNote(const Results& results);

}  // namespace capstan::experiments
