#pragma once

#include <cstdint>

#include "core/stats/interval.h"

namespace capstan::stats {

// Confidence intervals, within [0, 1], of a proportion of which `hits` of `trials` were observed. Both
// functions throw base::InputError for no trials, more hits than trials, or a confidence outside (0, 1).

/// Wilson's score interval (1927), (p̂ + z²/2n ± z √(p̂(1 − p̂)/n + z²/4n²)) / (1 + z²/n). Its average coverage
/// equals `confidence`: use it for plots.
Interval wilsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence = 0.95);

/// Interval of Clopper and Pearson (1934) from quantiles of the beta distribution. Its coverage is at least
/// `confidence`: use it for decisions.
Interval clopperPearsonInterval(std::uint64_t hits, std::uint64_t trials, double confidence = 0.95);

}  // namespace capstan::stats
