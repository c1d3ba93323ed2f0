#pragma once

#include "core/identification/convergence.h"
#include "core/identification/live_identification.h"

namespace capstan::identification {

/// A parameter of which nothing is known yet.
LiveRow rowOf(const Parameter& parameter);
/// `convergence` of the dual UKF; null: of a method that has none. `change` from the robot file [%].
LiveRow rowOf(const Estimate& estimate, const Convergence* convergence, double change);

/// What a screen multiplies SI with, and the unit then: kN where newtons would have more than four digits.
double scaleOf(const Parameter& parameter);
std::string unitOf(const Parameter& parameter);

}  // namespace capstan::identification
