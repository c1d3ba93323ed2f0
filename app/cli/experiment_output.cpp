#include "app/cli/experiment_output.h"

#include <fmt/format.h>

#include <cmath>

#include "core/experiments/comparison.h"
#include "core/experiments/results_json.h"

namespace capstan::cli {

std::string timesText(const std::vector<experiments::Results>& done, double seconds) {
  std::string text = "\n";
  for (const auto& results : done) {
    const std::size_t trials =
        results.identification ? results.identification->recordings.size() : results.trials.size();
    text += fmt::format("{:<12} {} {}", results.name, trials, trials == 1 ? "trial" : "trials");
    if (results.resumed > 0) text += fmt::format(", {} of them from an earlier run", results.resumed);
    if (std::isfinite(results.wall_seconds)) text += fmt::format(", {:.1f} s", results.wall_seconds);
    text += "\n";
  }
  return text + fmt::format("wall time    {:.1f} s\n", seconds);
}

std::string cancelledText(const std::vector<experiments::Results>& done, const std::string& out) {
  int kept = 0;
  for (const auto& results : done) kept += results.kept;
  if (kept == 0) return "cancelled before the first trial was finished: nothing is kept";
  return fmt::format("cancelled: {} finished {} kept in {}; the same command goes on from there", kept,
                     kept == 1 ? "trial is" : "trials are", out);
}

nlohmann::json jsonOf(const std::vector<experiments::Results>& done,
                      const experiments::Published& published) {
  nlohmann::json document = {{"experiments", nlohmann::json::object()}, {"goals", nlohmann::json::array()}};
  for (const auto& results : done) {
    nlohmann::json one = experiments::headOf(results);
    one.erase("specification");
    for (const auto& trial : results.trials) {
      nlohmann::json numbers = experiments::numbersOf(trial);
      numbers.erase("inputs");
      one["trials"].push_back(std::move(numbers));
    }
    if (results.identification) {
      one["identification"] = experiments::numbersOf(*results.identification);
      one["identification"].erase("inputs");
    }
    document["experiments"][results.name] = std::move(one);
  }
  for (const auto& goal : experiments::goalsOf(done, published))
    document["goals"].push_back({{"goal", goal.what},
                                 {"measured", goal.measured},
                                 {"met", goal.verdict == experiments::Verdict::kMet},
                                 {"verdict", base::keyOf(goal.verdict)}});
  return document;
}

}  // namespace capstan::cli
