#pragma once

#include <Eigen/Core>

#include "core/diagnosis/fit/fit.h"

namespace capstan::diagnosis {

/// Changes of the simulated readings, one number per FitData::channels(). The part that nuisances (initial
/// states, encoder zeros) can take up is subtracted first.
struct InputNoise {
  Eigen::VectorXd rms;  ///< [unit of the channel]
  /// Correlation length in readings, ≥ 1: n / N, where N independent readings out of n would make the sum of
  /// squares as uncertain as these changes do, N = 2 E(S)² / var(S) (Satterthwaite 1946).
  Eigen::VectorXd correlation;
};
/// RMS 0 of every channel, with correlation length 1.
InputNoise noInputNoise(Eigen::Index channels);

/// Changes by noise in the inputs (load cells; motor encoders of cable drives), from kInputDraws simulations
/// of the fitted robot with random noise on the inputs whose σ is that of the sensors. In rigid drives this
/// noise accumulates over time, and no model can explain it.
InputNoise inputNoise(const FitData& data, const Fit& at, const Weighting& weighting);
/// Changes by torques that a controller commands between two rows (withTorqueNoise()). It is an upper bound,
/// because torques may also be held from row to row. Zero for cable drives.
InputNoise torqueNoise(const FitData& data, const Fit& at, const Weighting& weighting);
inline constexpr int kInputDraws = 16;  ///< number of simulations with random input noise
/// If a residual's mean square, divided by that of the input noise, is at most this number, the residual may
/// be input noise alone. It is above 1 because this noise consists of a few slow oscillations with few
/// degrees of freedom.
inline constexpr double kSwings = 4.0;

}  // namespace capstan::diagnosis
