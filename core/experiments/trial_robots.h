#pragma once

#include <string>

#include "core/experiments/results.h"

/// Names of the robots behind the numbers of a trial.
namespace capstan::experiments {

/// Robot of the transmission kinematics in the trial's errors: "RAVEN-II left (nominal)"; empty: not known.
std::string kinematicRobotOf(const TrialResult& trial);
/// Robot that the filter assumed: the nominal one, a robot file, or "RAVEN-II left as identified by A, B".
std::string filterRobotOf(const Results& results, const TrialResult& trial);
/// Text on both robots: "kinematics and UKF of RAVEN-II left", "kinematics of nominal.yaml, UKF of
/// mine.yaml"; empty: not known.
std::string robotWords(const std::string& kinematic_robot, const std::string& filter_robot);

/// Sentence of robotWords() for the first trial with errors; empty: not known.
std::string robotNote(const Results& results);

}  // namespace capstan::experiments
