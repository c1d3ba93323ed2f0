#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "core/identification/parameters.h"
#include "core/stats/interval.h"

namespace capstan::identification {

/// One identified parameter.
struct Estimate {
  Parameter parameter;
  double log = 0.0;    ///< ln(w / nominal)
  double sigma = 0.0;  ///< standard deviation of the logarithm
  bool seen = false;   ///< the recording at least halves the prior's sigma
  std::string advice;  ///< plain words; empty where there is nothing to say

  double value() const { return parameter.nominal * std::exp(log); }  ///< SI
  double valueSigma() const { return value() * sigma; }               ///< SI, to first order
  double percent() const { return 100.0 * std::expm1(log); }          ///< change from nominal
  double low() const {
    return parameter.nominal * std::exp(log - stats::kNormal95 * sigma);
  }  ///< 95 % interval
  double high() const { return parameter.nominal * std::exp(log + stats::kNormal95 * sigma); }
};

/// σ of what a recording leaves of a prior of σ = 1, below which a parameter counts as seen.
inline constexpr double kSeenShare = 0.5;

/// Logarithms of the values, in their order.
inline std::vector<double> logsOf(const std::vector<Estimate>& estimates) {
  std::vector<double> logs;
  for (const Estimate& estimate : estimates) logs.push_back(estimate.log);
  return logs;
}

/// The nominal robot with every parameter that was seen; the others keep their nominal value.
inline robot::Description identifiedRobot(const ParameterSet& set, const std::vector<Estimate>& estimates) {
  ParameterSet::Logs logs = ParameterSet::Logs::Zero(set.size());
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& estimate = estimates[static_cast<std::size_t>(i)];
    if (estimate.seen) logs(i) = estimate.log;
  }
  return set.robot(logs);
}

}  // namespace capstan::identification
