#pragma once

#include <Eigen/Core>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// RMS change of the simulated readings by noise in the simulation's inputs (load cells; motor encoders of
/// cable drives), one number per FitData::channels() [unit of the channel], with nuisances subtracted. It is
/// estimated from kInputDraws simulations of the fit's robot with random noise of the sensors' size on the
/// inputs. In rigid drives this noise accumulates over time, and no model can explain it.
Eigen::VectorXd inputNoise(const FitData& data, const Fit& at, const Weighting& weighting);
inline constexpr int kInputDraws = 4;  ///< number of simulations with random input noise
/// Largest ratio of a residual's mean square to that of the input noise at which the residual can be input
/// noise. It is above 1 because this noise consists of a few slow oscillations with few degrees of freedom.
inline constexpr double kSwings = 4.0;

}  // namespace capstan::diagnosis
