#include "core/identification/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace capstan::identification {
namespace {

/// True when parameter i is settled at trace[k]: σ is below its goal, and no value of the last kRest seconds
/// differs by more than the goal.
bool settledAt(const Trace& trace, std::size_t k, int i, double goal) {
  if (trace[k].sigma(i) > goal || trace[k].t - trace.front().t < kRest) return false;
  for (std::size_t j = k; j-- > 0 && trace[k].t - trace[j].t <= kRest;)
    if (std::abs(trace[j].log(i) - trace[k].log(i)) > goal) return false;
  return true;
}

std::optional<double> timeNeeded(const Trace& trace, int i, double goal) {
  const TracePoint& now = trace.back();
  const auto before = std::find_if(trace.begin(), trace.end(),
                                   [&](const TracePoint& point) { return now.t - point.t <= kRest; });
  const double span = now.t - before->t;
  if (span < 0.5 * kRest) return std::nullopt;
  const double information = 1.0 / (now.sigma(i) * now.sigma(i));
  const double rate = (information - 1.0 / (before->sigma(i) * before->sigma(i))) / span;
  const double missing = 1.0 / (goal * goal) - information;
  if (missing <= 0.0) return 0.0;
  if (!(rate > 0.0)) return std::nullopt;
  return missing / rate;
}

}  // namespace

Convergence convergenceOf(const Trace& trace, const ParameterSet& set, int i) {
  Convergence found;
  if (trace.empty()) return found;
  const double goal = set[i].goal, prior = set[i].prior_sigma;
  found.settled = settledAt(trace, trace.size() - 1, i, goal);
  if (found.settled) {
    std::size_t since = trace.size() - 1;
    while (since > 0 && settledAt(trace, since - 1, i, goal)) --since;
    found.settled_at = trace[since].t - trace.front().t;
  }
  found.time_needed = timeNeeded(trace, i, goal);
  const double way = std::log(prior / goal);
  found.share = way > 0.0 ? std::clamp(std::log(prior / trace.back().sigma(i)) / way, 0.0, 1.0) : 1.0;
  return found;
}

std::string wordsOf(const Convergence& convergence, const Estimate& estimate) {
  constexpr double kLong = 3600.0;
  if (convergence.settled) return fmt::format("settled after {:.0f} s", *convergence.settled_at);
  if (!estimate.seen && !estimate.advice.empty()) return estimate.advice;
  if (!convergence.time_needed) return "it is too early to predict the time that is still needed";
  if (*convergence.time_needed <= 0.0) return "σ has reached its goal, but the value still changes";
  if (*convergence.time_needed > kLong)
    return "more than an hour of this motion is needed: another motion determines it sooner";
  return fmt::format("about {:.0f} s more of this motion are needed", std::ceil(*convergence.time_needed));
}

}  // namespace capstan::identification
