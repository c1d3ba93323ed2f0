#pragma once

#include "widgets/figures/theme.h"

/// Poses and errors of a correction, in the colours of what they speak of: commanded poses are what a
/// correction is to reach, what cameras saw the camera's, the rigid offset the first estimate, the correction
/// the last.
namespace capstan::widgets {

enum class PoseSource { kCommanded, kVisible, kOffset, kCorrected };

/// "commanded", "observed", "rigid offset", "corrected"
QString nameOf(PoseSource source);
Quantity quantityOf(PoseSource source);

}  // namespace capstan::widgets
