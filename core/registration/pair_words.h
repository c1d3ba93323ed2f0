#pragma once

#include <string>

#include "core/registration/pair_registration.h"

namespace capstan::registration {

struct RefusalWords {
  std::string reason;  ///< with its numbers
  std::string remedy;  ///< an imperative sentence
};

/// Why pairs of points give no registration, and what to do about it.
RefusalWords wordsOf(const PairRefusal& refusal);

/// What to doubt about a registration: more than a quarter of the pairs rejected, which a wrong robot file
/// does as well as wrong detections; or too few pairs to recognise a wrong one. Empty where there is nothing
/// to doubt.
std::string warningOf(const PairRegistration& registration);

}  // namespace capstan::registration
