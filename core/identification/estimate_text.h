#pragma once

#include <string>
#include <vector>

#include "core/identification/estimate.h"

/// What is taken of an identification, in sentences for people.
namespace capstan::identification {

/// "The values of r_l1 and k_e2 are identified." and keptText(); where no parameter is observable, only that.
std::string identifiedText(const std::vector<Estimate>& estimates);

/// Sentences on the parameters that are not observable: that they keep their values, and the reasons. Empty
/// if all are observable.
std::string keptText(const std::vector<Estimate>& estimates);

/// "Accept takes 5 of 12 values: r_l1, k_e2. The others keep their values." or that there is nothing to
/// accept.
std::string acceptText(const std::vector<Estimate>& estimates);

}  // namespace capstan::identification
