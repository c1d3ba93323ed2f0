#pragma once

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/effect_set.h"

namespace capstan::diagnosis {

/// Displacement of each joint and of the tip by one effect of the fit's model: the fitted robot is simulated
/// with the effect and without it; all other parameters are equal. Joints of rigid drives are compared window
/// by window, because the two motions of a rigid drive depart from each other without limit.
Displacements displacementsBy(const FitData& data, const Fit& fit, const EffectCandidate& effect,
                              const robot::Description& robot);

/// Displacement by the change of each of these nominal parameters (indices in FitModel::parameters()) from
/// its value in the robot file: the fitted robot is simulated with it and with that value; all other
/// parameters are equal.
std::vector<Displacements> displacementsByRefit(const FitData& data, const Fit& fit,
                                                const std::vector<int>& parameters,
                                                const robot::Description& robot);

/// True if the effect moves a joint by more than the tolerance, or the tip if it moves no joint: the RMS
/// exceeds the tolerance, or the largest displacement exceeds three times the tolerance.
bool isMaterial(const Displacements& moves, const Tolerance& tolerance);

}  // namespace capstan::diagnosis
