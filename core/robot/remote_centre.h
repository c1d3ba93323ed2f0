#pragma once

#include "core/robot/description.h"

namespace capstan::robot {

/// Throws base::InputError with the key for an arm that the closed forms do not cover. They cover arms with
/// three joints (revolute, revolute, prismatic) whose axes intersect in the origin of frame 0 (the remote
/// centre): all a = 0 and d_1 = d_2 = 0.
void requireRemoteCentreArm(const Description& description);

/// Throws base::InputError when the file has wrist rows that are not a tool with roll, wrist and jaw, with
/// alpha = (0, ±90°, ±90°), a = (0, 0, any), d = (any, 0, 0).
void requireToolWrist(const Description& description);

}  // namespace capstan::robot
