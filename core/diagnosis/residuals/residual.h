#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/stats/whiteness.h"

namespace capstan::diagnosis {

/// What a simulation says of a recording, on the rows and at the observations of its Evidence.
struct SimulatedMotion {
  Columns q;        ///< joint positions [rad or m]
  Columns dq;       ///< [rad/s or m/s]; empty: the slope of q
  Columns ddq;      ///< [rad/s² or m/s²]; empty: that of dq
  Columns tau;      ///< torque of drive or cable at the joint [N·m or N]; may be empty
  Columns stretch;  ///< of the cables, s_m − s_l [m]; may be empty
  /// Where the cameras should have seen the tip, observation by observation, frame 0 [m]; may be empty
  /// without cameras.
  std::vector<Eigen::Vector3d> tip;
};

/// Measured minus simulated of one sensor channel, where it was read and counts.
struct Channel {
  std::string name;         ///< "q2", "tip z"
  std::string unit;         ///< "rad" or "m"
  int joint = 0;            ///< from 1; 0: a camera's
  int axis = -1;            ///< of frame 0, from 0; −1: a joint encoder's
  double period = 0.0;      ///< between samples, typically [s]
  double noise = 0.0;       ///< standard deviation of the sensor's noise floor (ChannelNoise::floor)
  std::vector<double> t;    ///< rising [s]
  std::vector<double> row;  ///< place among the evidence's rows, TipObservation::row
  std::vector<double> measured, simulated, residual;

  std::size_t size() const { return t.size(); }
};

/// Channels of all joint encoders fitted, then of the tip. Channels without a sample that counts are left
/// out. base::InputError where the simulation has other joints, rows or observations than the evidence, or a
/// value that is not finite (with channel and time): a simulation that ran away.
std::vector<Channel> residualOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                const robot::Description& robot);

/// How much the simulation of a channel gets wrong, e = measured − simulated, in the channel's unit.
struct ChannelStatistics {
  std::string name, unit;
  std::size_t samples = 0;
  double rms = 0.0;   ///< √(Σe²/n)
  double mean = 0.0;  ///< of e
  double fit = 0.0;   ///< 100 (1 − ‖e‖ / ‖y − ȳ‖) [%]; NaN for a channel that never moves
  double noise = 0.0;
  /// max(0, 1 − noise² / rms²): share of the residual's mean square that is not the sensor's noise.
  double beyond_noise = 0.0;
  /// Ljung–Box of e decimated to `whiteness_period` (not averaged); p_value small: not white. NaN q with
  /// fewer than kFewestForWhiteness samples or an e that never changes.
  stats::LjungBox whiteness;
  double whiteness_period = 0.0;  ///< [s]
  /// Samples that e is worth for its mean: n over the number in which it forgets itself
  /// (decimated_residual.h).
  double effective_samples = 0.0;
};
inline constexpr std::size_t kFewestForWhiteness = 30;

/// base::InputError: a channel without samples.
ChannelStatistics statisticsOf(const Channel& channel);

}  // namespace capstan::diagnosis
