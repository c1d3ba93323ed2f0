#pragma once

#include "core/robot/description.h"

namespace capstan::robot {

/// The closed forms hold for arms of three joints, revolute, revolute, prismatic, whose axes meet in the
/// origin of frame 0 (the remote centre): all a = 0 and d_1 = d_2 = 0. Throws base::InputError, naming the
/// key, for any other.
void requireRemoteCentreArm(const Description& description);

/// The tool behind such an arm, when the file has wrist rows: roll, wrist, jaw with
/// alpha = (0, ±90°, ±90°), a = (0, 0, any), d = (any, 0, 0). Throws base::InputError for any other.
void requireToolWrist(const Description& description);

}  // namespace capstan::robot
