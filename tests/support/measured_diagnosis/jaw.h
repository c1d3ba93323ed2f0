#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnosis/selection/selection.h"
#include "core/robot/description.h"

namespace capstan::measured {

/// One step of model selection on the jaw of a da Vinci Si instrument (O'Neill, Stephens, Kowalewski 2018).
/// Effects are selected and parameters fitted on recordings under even load levels.
struct JawStep {
  std::string name;
  std::vector<std::string> competitors;  ///< Step::competitors
  robot::Description robot;
  double even_deg = 0.0;  ///< RMS over the recordings under even levels, with one encoder zero for all
  double odd_deg = 0.0;   ///< RMS over the recordings under odd levels, with the same zero
  double odd_zero_each_deg = 0.0;  ///< RMS over the recordings under odd levels, with a zero fitted to each
};

/// Steps from a rigid gear on, one per identified effect, at these frequencies ("0.1", "0.3"). The jaw's
/// encoder has one unknown zero for all recordings. A zero per recording would also absorb the stretch under
/// a load that is constant in each recording.
std::vector<JawStep> jawSteps(const std::filesystem::path& folder,
                              const std::vector<std::string>& frequencies,
                              const diagnosis::SearchOptions& options, int threads);

}  // namespace capstan::measured
