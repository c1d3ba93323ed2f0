#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::measured {

/// A robot file of tests/core/diagnosis/data.
robot::Description robotFile(const std::string& name);

/// A model on the way from the nominal structure to the selected one.
struct Step {
  std::string name;                      ///< of the effect that came last; "nominal structure" at first
  std::vector<std::string> competitors;  ///< effects that could not be distinguished from this choice
  diagnosis::Fit fit;
};

/// The refitted nominal structure, then with the effects of the selection, one more each time, by what each
/// is worth; not fitted to the end, for wholeFit() to do.
std::vector<Step> stepsOf(const diagnosis::FitData& data, const diagnosis::Selection& selection);

}  // namespace capstan::measured
