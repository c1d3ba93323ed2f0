#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace capstan::measured {

/// RMSE of open-loop simulations of a whole record, for two initial states [mm].
struct EmpsErrors {
  double at_rest = 0.0;  ///< from the first position with speed 0, although the carriage already moves
  double moving = 0.0;   ///< from position and speed of a parabola through the first 20 samples, the number
                         ///< that the benchmark's loader allows for the initial state
};

/// One step of model selection on the EMPS benchmark (Janot, Gautier, Brunot 2019). Effects are selected and
/// parameters fitted on its estimation record alone.
struct EmpsStep {
  std::string name;
  std::vector<std::string> competitors;  ///< Step::competitors
  robot::Description robot;              ///< parameters as diagnose() fits them: to simulations that restart
  EmpsErrors train, test;
  robot::Description whole;  ///< parameters refitted to the simulation of the whole record
  EmpsErrors whole_train, whole_test;
};

enum class EmpsStart { kThreeNumbers, kFourNumbers };  ///< mass and friction; the same with a constant force

/// Steps from the refitted rigid drive on, one per identified effect. Effects are selected with simulations
/// that restart as in diagnose(). Over a whole record force errors accumulate, and parameters that are fitted
/// to it make up for what the model lacks: they may be worse on another record.
std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, EmpsStart start, int threads);

/// Errors of one robot on one record; the force is held between rows.
EmpsErrors openLoopErrors(const robot::Description& robot, const std::filesystem::path& record);

}  // namespace capstan::measured
