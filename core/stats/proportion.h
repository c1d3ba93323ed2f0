#pragma once

#include <cstdint>

#include "core/stats/interval.h"

namespace capstan::stats {

/// Confidence intervals of a proportion from `hits` of `trials`, within [0, 1]. base::InputError: no trials,
/// more hits than trials, a confidence outside (0, 1).

/// Wilson's score interval (1927), (p̂ + z²/2n ± z √(p̂(1 − p̂)/n + z²/4n²)) / (1 + z²/n): covers on average
/// what it says, the one to plot.
Interval wilsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence = 0.95);

/// Clopper and Pearson's (1934) from quantiles of the beta distribution: covers at least what it says, the
/// one to decide by.
Interval clopperPearsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence = 0.95);

}  // namespace capstan::stats
