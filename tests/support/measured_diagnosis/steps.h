#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::measured {

/// A robot file of tests/core/diagnosis/data.
robot::Description robotFile(const std::string& name);

/// A model on the way of a forward selection.
struct Step {
  std::string name;                      ///< of the effect that came last; "nominal structure" at first
  std::vector<std::string> competitors;  ///< effects that could not be distinguished from this choice
  diagnosis::Fit fit;
};

/// The refitted nominal structure, then each effect that stayed, as it came: with those that came before,
/// also such as were dropped at the end; not fitted to the end, for wholeFit() to do.
std::vector<Step> stepsOf(const diagnosis::Selection& selection);

}  // namespace capstan::measured
