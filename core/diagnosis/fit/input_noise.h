#pragma once

#include <Eigen/Core>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// What noise of the sensors that drive a simulation (load cells; motor encoders of cable drives) makes of
/// it: RMS [unit of the channel], a number each of FitData::channels(), nuisances taken off. Simulations of
/// the fit's robot with noise of their size added, as often as kInputDraws; of rigid drives it adds up, and
/// no model explains it.
Eigen::VectorXd inputNoise(const FitData& data, const Fit& at, const Weighting& weighting);
inline constexpr int kInputDraws = 4;
/// Mean square, in that of the inputs' noise, up to which a few slow oscillations of it remain: it has
/// few degrees of freedom.
inline constexpr double kSwings = 4.0;

}  // namespace capstan::diagnosis
