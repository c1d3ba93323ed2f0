#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace capstan::measured {

/// Open-loop simulations of whole records, RMSE [mm].
struct EmpsErrors {
  double at_rest = 0.0;  ///< from the first position at rest, though the carriage moves already
  double moving = 0.0;   ///< from where, and how fast, a parabola through the first 20 samples begins: as
                         ///< many as the benchmark's loader grants for the initial state
};

/// The EMPS benchmark (Janot, Gautier, Brunot 2019): effects are chosen, and numbers fitted, by its
/// estimation record alone.
struct EmpsStep {
  std::string name;
  std::vector<std::string> competitors;  ///< as in Step
  robot::Description robot;
  EmpsErrors train, test;
};

enum class EmpsStart { kThreeNumbers, kFourNumbers };  ///< mass and friction; with them a constant force

/// The rigid drive refitted, then each effect that is named, in their order: chosen by simulations that start
/// again as often as diagnose() has it, numbers fitted to the simulation of the whole record.
std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, EmpsStart start, int threads);

/// The force is held between rows.
EmpsErrors openLoopErrors(const robot::Description& robot, const std::filesystem::path& record);

}  // namespace capstan::measured
