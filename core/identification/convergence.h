#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/identification/estimate.h"

namespace capstan::identification {

/// The estimates at one time of a recording.
struct TracePoint {
  double t = 0.0;            ///< [s]
  ParameterSet::Logs log;    ///< ln(w / nominal)
  ParameterSet::Logs sigma;  ///< standard deviation of the logarithm
};
using Trace = std::vector<TracePoint>;

/// How far one parameter has come. Measured on the trace, never assumed.
struct Convergence {
  bool settled = false;              ///< σ is below its goal and the value has rested
  std::optional<double> settled_at;  ///< since when it has been settled, from the recording's start [s]
  std::optional<double>
      time_needed;     ///< more of this motion until σ reaches its goal [s]; none: not predictable
  double share = 0.0;  ///< of the way from the prior's σ to the goal, in ln σ: 0…1
};

/// Over `rest` seconds the estimate must have moved by less than the goal for its σ.
inline constexpr double kRest = 20.0;

/// Of parameter i at the end of `trace`. σ falls as 1 / √(information), and information comes in evenly with
/// time: what is still needed is extrapolated from the rate of the last `kRest` seconds.
Convergence convergenceOf(const Trace& trace, const ParameterSet& set, int i);

/// "settled after 41 s", "about 90 s more of this motion", or what is wrong.
std::string wordsOf(const Convergence& convergence, const Estimate& estimate);

}  // namespace capstan::identification
