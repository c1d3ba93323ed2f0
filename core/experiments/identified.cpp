#include "core/experiments/identified.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace capstan::experiments {
namespace {

using identification::BatchEnd;
using identification::DualUkfEnd;
using identification::Estimate;

bool leavesEstimates(DualUkfEnd end) {
  return end == DualUkfEnd::kRecordingEnded || end == DualUkfEnd::kSettled;
}
bool leavesEstimates(BatchEnd end) { return end == BatchEnd::kConverged || end == BatchEnd::kIterationLimit; }

/// Reason why `report` cannot be used; empty where it can.
template <class Report>
std::string faultOf(const Report* report) {
  if (!report) return "was not requested";
  if (!leavesEstimates(report->end)) return std::string(base::nameOf(report->end));
  const bool finite = std::all_of(
      report->estimates.begin(), report->estimates.end(),
      [](const Estimate& estimate) { return std::isfinite(estimate.log) && std::isfinite(estimate.sigma); });
  return report->estimates.empty() || !finite ? "gave no finite numbers" : "";
}

std::string oneLine(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return text;
}

}  // namespace

Choice choose(Method requested, const identification::DualUkfReport* dual,
              const identification::BatchReport* batch) {
  const std::string dual_fault = faultOf(dual), batch_fault = faultOf(batch);
  const bool by_dual = requested == Method::kDualUkf;
  const std::string& fault = by_dual ? dual_fault : batch_fault;
  const std::string& other = by_dual ? batch_fault : dual_fault;
  if (fault.empty()) return {requested, {}};
  const std::string why =
      fmt::format("the {} method found nothing ({})", by_dual ? "dual UKF" : "batch", fault);
  if (other.empty())
    return {by_dual ? Method::kBatch : Method::kDualUkf,
            fmt::format("{}: the result is that of the {}", why, by_dual ? "batch method" : "dual UKF")};
  const bool asked = by_dual ? batch != nullptr : dual != nullptr;
  return {{},
          asked ? fmt::format("{}, nor did the {} ({})", why, by_dual ? "batch method" : "dual UKF", other)
                : why};
}

bool foundSomething(const std::string& end) {
  const auto dual = base::fromName<DualUkfEnd>(end);
  const auto batch = base::fromName<BatchEnd>(end);
  if (dual) return leavesEstimates(*dual);
  return !batch || leavesEstimates(*batch);
}

std::string progressWords(const identification::Convergence& convergence, const Estimate& estimate) {
  const std::string words = identification::wordsOf(convergence, estimate);
  const double goal = estimate.parameter.goal;
  if (convergence.settled || words == estimate.advice || !(estimate.sigma > goal)) return words;
  return fmt::format("{} (σ is {:.2g} %, its goal {:.2g} %)", words, 100.0 * estimate.sigma, 100.0 * goal);
}

std::string valueLine(const std::string& name, double value, double sigma, const std::string& unit,
                      bool seen) {
  if (!seen) return name + " not observable, as before";
  return fmt::format("{} {:.6g} ± {:.2g} {}", name, value, sigma, unit);
}

std::string identifiedRobotText(const robot::Description& nominal, const robot::Description& identified,
                                const RobotOrigin& origin) {
  std::string text =
      fmt::format("# Identified from {}", oneLine(fmt::format("{}", fmt::join(origin.recordings, ", "))));
  if (origin.duration > 0.0) text += fmt::format(", {:.1f} s", origin.duration);
  text += fmt::format(", by the {} method", origin.method);
  if (!origin.software.empty()) text += " of " + oneLine(origin.software);
  text += "; value ± one standard deviation:\n";
  for (const std::string& value : origin.values) text += "#   " + value + "\n";
  text += fmt::format("# It differs from {} in:\n", oneLine(nominal.name));
  for (const auto& change : identification::differences(nominal, identified))
    text += fmt::format("#   {}: {:.6g} instead of {:.6g} ({:+.2f} %)\n", change.key, change.identified,
                        change.nominal, change.percent);
  return text + robot::formatDescription(identified);
}

}  // namespace capstan::experiments
