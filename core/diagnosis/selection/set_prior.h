#pragma once

#include "core/diagnosis/selection/set_fit.h"

namespace capstan::diagnosis {

/// Log prior of the set and of the instants of its effects that happen once: such an effect may have happened
/// in any of the `instants` that score tests try.
double logPrior(const EffectSet& effects, int candidates, double instants);
/// The same with the log prior of the fitted values (FitModel::logPrior()): masses, friction and effects that
/// are far from usual need more evidence.
double logPrior(const SetFit& set, int candidates, double instants);

}  // namespace capstan::diagnosis
