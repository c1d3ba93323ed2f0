#pragma once

#include <Eigen/Core>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// RMS change of the simulated readings that noise in the inputs (load cells; motor encoders of cable drives)
/// causes, one number per FitData::channels() [unit of the channel]. The part that nuisances (initial states,
/// encoder zeros) can take up is subtracted first. The RMS is estimated from kInputDraws simulations of the
/// fitted robot, with random noise on the inputs whose σ is that of the sensors. In rigid drives this noise
/// accumulates over time, and no model can explain it.
Eigen::VectorXd inputNoise(const FitData& data, const Fit& at, const Weighting& weighting);
/// RMS change of the simulated readings, as above, that torques cause which a controller commands between two
/// rows (withTorqueNoise()). It is an upper bound, because torques may also be held from row to row. Zero for
/// cable drives.
Eigen::VectorXd torqueNoise(const FitData& data, const Fit& at, const Weighting& weighting);
inline constexpr int kInputDraws = 4;  ///< number of simulations with random input noise
/// If a residual's mean square, divided by that of the input noise, is at most this number, the residual may
/// be input noise alone. It is above 1 because this noise consists of a few slow oscillations with few
/// degrees of freedom.
inline constexpr double kSwings = 4.0;

}  // namespace capstan::diagnosis
