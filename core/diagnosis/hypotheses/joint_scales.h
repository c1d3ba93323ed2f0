#pragma once

#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// Scales of each joint: constants of the robot file; the highest speed in the recordings (99 % quantile), or
/// max_speed of the file if nothing moves; the duration of the longest recording; the largest measured load.
/// The stretch is that of a cable under gravity in the middle of the range plus twice the Coulomb friction.
/// Rigid drives have stiffness and stretch 0.
std::vector<JointScales> jointScales(const std::vector<Evidence>& recordings,
                                     const robot::Description& robot);

}  // namespace capstan::diagnosis
