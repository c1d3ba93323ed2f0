#pragma once

#include <vector>

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// The sizes that fits start from, joint by joint: numbers of the robot file; the top speed (99 % quantile)
/// and duration of the recordings; the stretch that gravity in the middle of the range and twice the Coulomb
/// friction make; the largest measured load. Rigid drives have stiffness and stretch 0.
std::vector<JointScales> jointScales(const std::vector<Evidence>& recordings,
                                     const robot::Description& robot);

}  // namespace capstan::diagnosis
