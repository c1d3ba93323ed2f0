#pragma once

#include <cmath>

#include "core/base/random.h"

namespace capstan::test {

/// Random number between `low` and `high` (both positive) whose logarithm is uniform.
inline double logUniform(base::Random& random, double low, double high) {
  return std::exp(random.uniform(std::log(low), std::log(high)));
}

}  // namespace capstan::test
