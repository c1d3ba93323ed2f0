#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "core/identification/parameters.h"
#include "core/stats/interval.h"

namespace capstan::identification {

/// Reason why the estimate of a parameter is not good enough.
enum class Weakness {
  kNone,
  kNoObservations,  ///< no camera observation can be used
  kSmallEffect,     ///< it changes the output by less than the camera noise
  kCorrelated,      ///< it cannot be distinguished from another unknown
  kNoBetter,        ///< its σ is that of the prior
  kHidden,          ///< friction and hysteresis outside the model hide it
};

/// One identified parameter.
struct Estimate {
  Parameter parameter;
  double log = 0.0;                     ///< ln(w / nominal)
  double sigma = 0.0;                   ///< standard deviation of the logarithm
  bool seen = false;                    ///< observable: the recording at least halves the prior's sigma
  std::string advice;                   ///< advice for the user; may be empty
  Weakness weakness = Weakness::kNone;  ///< reason of `advice`

  double value() const { return parameter.nominal * std::exp(log); }  ///< value, SI
  double valueSigma() const { return value() * sigma; }       ///< standard deviation to first order, SI
  double percent() const { return 100.0 * std::expm1(log); }  ///< change from nominal
  double low() const {
    return parameter.nominal * std::exp(log - stats::kNormal95 * sigma);
  }  ///< limits of the 95 % interval, SI
  double high() const { return parameter.nominal * std::exp(log + stats::kNormal95 * sigma); }
};

/// Largest posterior σ / prior σ at which a parameter counts as observable (Estimate::seen).
inline constexpr double kSeenShare = 0.5;

/// Huber's limit: size of a whitened residual or innovation above which its observation is down-weighted. It
/// is the 99 % quantile of the χ distribution with 3 degrees of freedom.
inline constexpr double kHuberLimit = 3.37;
/// Length of the blocks of an error that is correlated in time [s]: errors of different blocks count as
/// independent.
inline constexpr double kCorrelationBlock = 2.0;

/// Logarithms of `estimates`, in their order.
inline std::vector<double> logsOf(const std::vector<Estimate>& estimates) {
  std::vector<double> logs;
  for (const Estimate& estimate : estimates) logs.push_back(estimate.log);
  return logs;
}

/// The nominal robot with the estimates of all observable parameters; the other parameters keep their nominal
/// value.
inline robot::Description identifiedRobot(const ParameterSet& set, const std::vector<Estimate>& estimates) {
  ParameterSet::Logs logs = ParameterSet::Logs::Zero(set.size());
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& estimate = estimates[static_cast<std::size_t>(i)];
    if (estimate.seen) logs(i) = estimate.log;
  }
  return set.robot(logs);
}

}  // namespace capstan::identification
