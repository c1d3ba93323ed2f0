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
  robot::Description robot;
  EmpsErrors train, test;
};

enum class EmpsStart { kThreeNumbers, kFourNumbers };  ///< mass and friction; the same with a constant force

/// Steps from the refitted rigid drive on, one per identified effect. Effects are selected with simulations
/// that restart as in diagnose(); parameters are fitted to the simulation of the whole record.
std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, EmpsStart start, int threads);

/// Errors of one robot on one record; the force is held between rows.
EmpsErrors openLoopErrors(const robot::Description& robot, const std::filesystem::path& record);

}  // namespace capstan::measured
