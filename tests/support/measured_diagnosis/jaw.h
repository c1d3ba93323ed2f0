#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnosis/selection/selection.h"
#include "core/robot/description.h"

namespace capstan::measured {

/// The jaw of a da Vinci Si instrument (O'Neill, Stephens, Kowalewski 2018): effects are chosen, and numbers
/// fitted, on recordings under even load levels.
struct JawStep {
  std::string name;
  std::vector<std::string> competitors;  ///< as in Step
  robot::Description robot;
  double even_deg = 0.0;  ///< RMS over the recordings under even levels, with one encoder zero for all
  double odd_deg = 0.0;   ///< over those under odd levels, with that zero
  double odd_zero_each_deg = 0.0;  ///< likewise, with a zero fitted for each of them
};

/// From a rigid gear on, each effect that is named, in their order, at these frequencies ("0.1", "0.3"). The
/// jaw's encoder has one zero for all recordings, which is not known: a zero for each would take with it the
/// stretch under loads that are constant in each.
std::vector<JawStep> jawSteps(const std::filesystem::path& folder,
                              const std::vector<std::string>& frequencies,
                              const diagnosis::SearchOptions& options, int threads);

}  // namespace capstan::measured
