#include "core/experiments/trial_cost.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "core/stats/quantile.h"

namespace capstan::experiments {
namespace {

constexpr double kMillion = 1e6;

/// A time for people: seconds, hours, days or years.
std::string durationText(double seconds) {
  if (!std::isfinite(seconds)) return "–";
  if (seconds < 3600.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 48.0 * 3600.0) return fmt::format("{:.1f} h", seconds / 3600.0);
  if (seconds < 730.0 * 86400.0) return fmt::format("{:.1f} days", seconds / 86400.0);
  return fmt::format("{:.1f} years", seconds / (365.25 * 86400.0));
}

}  // namespace

TrialCost costOf(const std::vector<double>& seconds) {
  std::vector<double> known;
  for (const double one : seconds)
    if (std::isfinite(one)) known.push_back(one);
  TrialCost cost;
  cost.trials = known.size();
  cost.median = stats::median(known);
  cost.high = stats::quantile(known, 0.95);
  cost.total = std::accumulate(known.begin(), known.end(), 0.0);
  cost.mean = cost.total / static_cast<double>(known.size());
  return cost;
}

base::Table costTable(const TrialCost& cost) {
  base::Table table;
  table.title = "Computing time of the trials";
  table.columns = {{"trials", {}, 0},
                   {"median", "s", 3},
                   {"95 %", "s", 3},
                   {"mean", "s", 3},
                   {"10^6 trials: 1 core", {}, 0},
                   {"16 cores", {}, 0},
                   {"64 cores", {}, 0},
                   {"256 cores", {}, 0},
                   {"1024 cores", {}, 0}};
  std::vector<base::TableCell> row = {static_cast<double>(cost.trials), cost.median, cost.high, cost.mean};
  for (const double cores : {1.0, 16.0, 64.0, 256.0, 1024.0})
    row.emplace_back(durationText(cost.predicted(kMillion, cores)));
  table.rows = {row};
  table.note =
      "Elapsed time of a trial on one worker thread, as it was measured when the trial ran; on busy cores it "
      "is longer. 10^6 trials: 10^6 × mean / cores. Starting a program and merging are not included.";
  return table;
}

nlohmann::json costJson(const TrialCost& cost) {
  return {{"trials", cost.trials},
          {"median", cost.median},
          {"quantile_95", cost.high},
          {"mean", cost.mean},
          {"total", cost.total}};
}

}  // namespace capstan::experiments
