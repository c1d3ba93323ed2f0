#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/stats/whiteness.h"

namespace capstan::diagnosis {

/// Simulated motion of a recording, on the rows and at the tip observations of its Evidence.
struct SimulatedMotion {
  Columns q;        ///< joint positions [rad or m]
  Columns dq;       ///< joint velocities [rad/s or m/s]; empty: the slope of q is used
  Columns ddq;      ///< joint accelerations [rad/s² or m/s²]; empty: the slope of dq is used
  Columns tau;      ///< torque of the drive or cable at the joint [N·m or N]; may be empty
  Columns stretch;  ///< stretch of the cables, s_m − s_l [m]; may be empty
  /// Simulated camera measurement of the tip at each observation, in frame 0 [m]; may be empty without
  /// cameras.
  std::vector<Eigen::Vector3d> tip;
};

/// Measured, simulated and residual (measured − simulated) samples of one sensor channel. Includes only
/// samples with a reading in a row that is not excluded.
struct Channel {
  std::string name;         ///< "q2", "tip z"
  std::string unit;         ///< "rad" or "m"
  int joint = 0;            ///< joint of the encoder, from 1; 0: a camera channel
  int axis = -1;            ///< axis of frame 0, from 0; −1: a joint encoder
  double period = 0.0;      ///< median time between samples [s]
  double noise = 0.0;       ///< standard deviation of the sensor's noise floor (ChannelNoise::floor)
  std::vector<double> t;    ///< times, rising [s]
  std::vector<double> row;  ///< positions among the evidence's rows, as TipObservation::row
  std::vector<double> measured, simulated, residual;

  std::size_t size() const { return t.size(); }
};

/// Channels of all joint encoders, then of the tip; channels without a counting sample are excluded. Throws
/// base::InputError if the simulation has other numbers of joints, rows or observations than the evidence, or
/// a value that is not finite because the simulation diverged (with channel and time).
std::vector<Channel> residualOf(const Evidence& evidence, const SimulatedMotion& simulated,
                                const robot::Description& robot);

/// Statistics of a channel's residual e = measured − simulated, in the channel's unit.
struct ChannelStatistics {
  std::string name, unit;
  std::size_t samples = 0;
  double rms = 0.0;    ///< √(Σe²/n)
  double mean = 0.0;   ///< mean of e
  double fit = 0.0;    ///< 100 (1 − ‖e‖ / ‖y − ȳ‖) [%]; NaN for a channel that never moves
  double noise = 0.0;  ///< Channel::noise
  /// Share of the residual's mean square that is not sensor noise: max(0, 1 − noise² / rms²).
  double beyond_noise = 0.0;
  /// Ljung–Box test of e, decimated to `whiteness_period` without averaging; a small p_value means not white.
  /// q is NaN with fewer than kFewestForWhiteness samples, and if e never changes.
  stats::LjungBox whiteness;
  double whiteness_period = 0.0;  ///< time between the decimated samples [s]
  /// Effective number of samples of e for its mean, effectiveSamples() (decimated_residual.h).
  double effective_samples = 0.0;
};
inline constexpr std::size_t kFewestForWhiteness = 30;

/// Statistics of a channel. Throws base::InputError for a channel without samples.
ChannelStatistics statisticsOf(const Channel& channel);

}  // namespace capstan::diagnosis
