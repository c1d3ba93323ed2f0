#pragma once

#include <string>
#include <vector>

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/selection/selection.h"

namespace capstan::measured {

/// Robot of a file in tests/core/diagnosis/data.
robot::Description robotFile(const std::string& name);

/// One model of a forward selection.
struct Step {
  std::string name;  ///< effect that was added last; "nominal structure" for the first model
  std::vector<std::string> competitors;  ///< effects that the data cannot distinguish from the added one
  diagnosis::Fit fit;
};

/// Models of a selection: the refitted nominal structure, then one model per effect that was kept to the end,
/// with all effects that were added before it. Their fits have not converged; wholeFit() completes them.
std::vector<Step> stepsOf(const diagnosis::Selection& selection);

}  // namespace capstan::measured
