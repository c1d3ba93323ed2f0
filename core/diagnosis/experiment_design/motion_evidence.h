#pragma once

#include "core/diagnosis/evidence/evidence.h"
#include "core/diagnosis/experiment_design/test_motion.h"
#include "core/robot/description.h"

namespace capstan::diagnosis {

/// Recording of a motion that the nominal robot would give without cable stretch: motors by the transmission,
/// and the sensors that `like` has (joint encoders, cameras at kCameraRate). Its values contain no noise; its
/// stated noise levels are those of `like`. For cable drives; without loads.
Evidence motionEvidence(const TestMotion& motion, const robot::Description& nominal, const Evidence& like);
inline constexpr double kCameraRate = 30.0;  ///< [Hz]

}  // namespace capstan::diagnosis
