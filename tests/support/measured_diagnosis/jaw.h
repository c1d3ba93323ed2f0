#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace capstan::measured {

/// The jaw of a da Vinci Si instrument (O'Neill, Stephens, Kowalewski 2018): effects are chosen, and numbers
/// fitted, on recordings under even load levels.
struct JawStep {
  std::string name;
  robot::Description robot;
  /// RMS over recordings under odd load levels, the encoder's zero fitted for each of them, or once for all
  /// to the recordings under even levels.
  double zero_each_deg = 0.0, zero_once_deg = 0.0;
};

/// From a rigid gear on, each effect that is named, in their order, at these frequencies ("0.1", "0.3").
std::vector<JawStep> jawSteps(const std::filesystem::path& folder,
                              const std::vector<std::string>& frequencies, int threads);

}  // namespace capstan::measured
