#pragma once

#include "tests/support/planted/planted_case.h"

namespace capstan::study {

/// How far the first effect of a case moves what the sensors tell, in standard deviations of everything else
/// that may move it the same way: what an observer could make of the recording who has the true model itself,
/// knows the truth but for the ageing (and the texture, where there is one) and knows how those are drawn:
///     D² = dᵀ (Σ + J P Jᵀ)⁻¹ d
/// d: change of all sensors' readings by the effect, open loop over the motion of the robot without it; Σ:
/// the sensors' white noise; J: change by each aged number of each joint (stiffness, damping, friction of
/// joint and motor, mass, centre of mass) and by the everyday texture; P: their variances as they are drawn.
/// Linear in the ageing. From the case's first `seconds`, taken to come as often as its length has room for.
double deflectionOf(const test::PlantedCase& planted_case, const test::Truth& truth, double seconds = 8.0);

/// D at which such an observer, who raises a false alarm in 3 % of sound robots and has 60 effects and joints
/// to choose from, finds half of all: normal quantile at 1 − 0.03/120.
inline constexpr double kHalfFound = 3.48;

/// Size at which D is kHalfFound, if D ∝ size.
double idealLimit(double size, double deflection);

}  // namespace capstan::study
