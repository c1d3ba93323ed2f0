#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace capstan::measured {

/// The EMPS benchmark (Janot, Gautier, Brunot 2019): effects are chosen, and numbers fitted, by its
/// estimation record alone.
struct EmpsStep {
  std::string name;
  robot::Description robot;
  double train_mm = 0.0, test_mm = 0.0;  ///< RMSE of open-loop simulations, as openLoopError()
};

/// The rigid drive without offset, then each effect that is named, in their order.
std::vector<EmpsStep> empsSteps(const std::filesystem::path& folder, int threads);

/// RMSE [m] of one open-loop simulation over a whole record, from its first position at rest: the benchmark's
/// figure. The force is held between rows.
double openLoopError(const robot::Description& robot, const std::filesystem::path& record);

}  // namespace capstan::measured
