#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/identification/estimate.h"

namespace capstan::identification {

/// Estimates at one time of a recording.
struct TracePoint {
  double t = 0.0;            ///< [s]
  ParameterSet::Logs log;    ///< ln(w / nominal)
  ParameterSet::Logs sigma;  ///< standard deviation of the logarithm
};
using Trace = std::vector<TracePoint>;

/// Progress of one parameter towards its goal, measured on the trace.
struct Convergence {
  bool settled = false;              ///< σ is below its goal and the value is steady
  std::optional<double> settled_at;  ///< time since which it has been settled, from the recording's start [s]
  std::optional<double>
      time_needed;     ///< further time of this motion until σ reaches its goal [s]; none: not predictable
  double share = 0.0;  ///< progress of ln σ from the prior's σ to the goal: 0…1
};

/// Window in which a settled estimate must have moved by less than the goal for its σ [s].
inline constexpr double kRest = 20.0;

/// Convergence of parameter i at the end of `trace`. σ falls as 1 / √(information), and information grows
/// about linearly with time, so time_needed is extrapolated from its rate in the last kRest seconds.
Convergence convergenceOf(const Trace& trace, const ParameterSet& set, int i);

/// Text for people: "settled after 41 s", "about 90 s more of this motion are needed", or the advice of the
/// estimate.
std::string wordsOf(const Convergence& convergence, const Estimate& estimate);

}  // namespace capstan::identification
