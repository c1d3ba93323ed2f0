#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/diagnosis/fit.h"
#include "core/diagnosis/selection.h"

namespace capstan::measured {

/// The folder of measured data: what CAPSTAN_DATA names, or ../shared/data beside the checkout.
std::filesystem::path dataFolder();
/// A robot file of tests/core/diagnosis/data.
robot::Description robotFile(const std::string& name);

/// A model on the way of a forward selection.
struct Step {
  std::string name;                 ///< of the effect that came last; "nominal structure" at first
  std::vector<std::string> rivals;  ///< effects that this choice could not be told from
  diagnosis::Fit fit;
};

/// The refitted nominal structure, then each effect as it came, without those that were dropped again; not
/// fitted to the end, for wholeFit() to do.
std::vector<Step> stepsOf(const diagnosis::Selection& selection);

}  // namespace capstan::measured
