#pragma once

#include "core/diagnosis/fit/fit.h"
#include "core/diagnosis/report/report.h"
#include "core/diagnosis/selection/effect_set.h"

namespace capstan::diagnosis {

/// How far one effect of the fit's model moves each joint and the tip: simulations of the fitted robot with the effect and
/// without it, all other numbers alike. Joints of rigid drives are compared window by window, since their motion without the
/// effect departs without limit.
Displacements displacementsBy(const FitData& data, const Fit& fit, const EffectCandidate& effect,
                              const robot::Description& robot);

/// True if the effect moves a joint (or, where it moves no joint, the tip) by more than the tolerance.
bool isMaterial(const Displacements& moves, const Tolerance& tolerance);

}  // namespace capstan::diagnosis
