#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/table.h"

namespace capstan::experiments {

/// Elapsed time of trials, each of which ran on one worker thread.
struct TrialCost {
  std::size_t trials = 0;           ///< number of trials with a measured time
  double median = 0.0, high = 0.0;  ///< median and 95 % quantile [s]; NaN without trials
  double mean = 0.0, total = 0.0;   ///< [s]; the mean is NaN without trials
  /// Elapsed time of `count` trials on `cores` cores that are never idle: count · mean / cores [s].
  double predicted(double count, double cores) const { return count * mean / cores; }
};

/// Cost of trials with the elapsed times `seconds`. NaN values are excluded.
TrialCost costOf(const std::vector<double>& seconds);
/// Table of the seconds per trial, and of the time of 10⁶ trials by number of cores.
base::Table costTable(const TrialCost& cost);
/// {"trials", "median", "quantile_95", "mean", "total"} in seconds.
nlohmann::json costJson(const TrialCost& cost);

}  // namespace capstan::experiments
