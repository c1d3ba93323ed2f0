#pragma once

#include "widgets/figures/theme.h"

/// Source of poses, or of errors, of a correction. Its colour is that of the corresponding quantity:
/// commanded poses as true values, observed poses as the camera, the rigid offset as the first estimate
/// (kinematic), the correction as the last (UKF).
namespace capstan::widgets {

enum class PoseSource { kCommanded, kVisible, kOffset, kCorrected };

/// "commanded", "observed", "rigid offset", "corrected"
QString nameOf(PoseSource source);
Quantity quantityOf(PoseSource source);

}  // namespace capstan::widgets
