#include "tests/support/planted_study/detection_limit.h"

#include <algorithm>
#include <cmath>

namespace capstan::study {
namespace {

/// Trials of one fitted share.
struct Step {
  double first = 0.0, last = 0.0;  ///< sizes
  double found = 0.0, trials = 0.0;
  double share() const { return found / trials; }
};

std::vector<Step> isotonic(const std::vector<Trial>& trials) {
  std::vector<Step> steps;
  for (const Trial& trial : trials) {
    steps.push_back({trial.size, trial.size, trial.found ? 1.0 : 0.0, 1.0});
    while (steps.size() > 1) {
      const Step& upper = steps.back();
      Step& lower = steps[steps.size() - 2];
      if (lower.share() < upper.share() && lower.last < upper.first) break;
      lower = {lower.first, upper.last, lower.found + upper.found, lower.trials + upper.trials};
      steps.pop_back();
    }
  }
  return steps;
}

DetectionLimit within(double low, double high) {
  return {DetectionLimit::Kind::kWithin, std::sqrt(low * high), low, high};
}

}  // namespace

DetectionLimit detectionLimit(std::vector<Trial> trials) {
  if (trials.size() < kFewestTrials) return {};
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.size < b.size; });
  const std::vector<Step> steps = isotonic(trials);
  const double smallest = trials.front().size, largest = trials.back().size;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Step& step = steps[k];
    if (step.share() < 0.5) continue;
    if (step.share() == 0.5) return within(step.first, step.last);
    if (k == 0) return {DetectionLimit::Kind::kBelow, smallest, 0.0, smallest};
    return within(steps[k - 1].last, step.first);
  }
  return {DetectionLimit::Kind::kAbove, largest, largest, largest};
}

}  // namespace capstan::study
