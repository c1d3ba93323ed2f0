#pragma once

#include "core/identification/convergence.h"
#include "core/identification/live_identification.h"

namespace capstan::identification {

/// Row of a parameter without an estimate.
LiveRow rowOf(const Parameter& parameter);
/// Row of `estimate`. `convergence`: that of the dual UKF; null for the batch method. `change`: relative to
/// the robot file [%].
LiveRow rowOf(const Estimate& estimate, const Convergence* convergence, double change);

/// Factor from SI to unitOf(), and unit on the screen: kN where newtons would have more than four digits.
double scaleOf(const Parameter& parameter);
std::string unitOf(const Parameter& parameter);

}  // namespace capstan::identification
