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

}  // namespace capstan::registration
