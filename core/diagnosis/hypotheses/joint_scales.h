#pragma once

#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// Scales of each joint: from the robot file, the highest speed (99 % quantile) and the longest duration of
/// the recordings, and the largest measured load. The stretch is that by gravity in the middle of the range
/// plus twice the Coulomb friction. Rigid drives have stiffness and stretch 0.
std::vector<JointScales> jointScales(const std::vector<Evidence>& recordings,
                                     const robot::Description& robot);

}  // namespace capstan::diagnosis
