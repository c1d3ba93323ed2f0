#pragma once

#include <Eigen/Geometry>

#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// Nominal pose of the left camera in frame 0. The rig is fixed to the base with its axes along the base's:
/// its picture's down is the direction of gravity, its view horizontal along the y axis of frame 0, from the
/// side on which the tool works, about half a metre from the block-transfer board, midway between board and
/// hard stop. For the left arm the camera's x, y, z are frame 0's −z, −x, +y. The rotation is known by
/// construction (UKF paper, section II-A); the translation is what registration finds.
Eigen::Isometry3d nominalBaseFromCamera(const robot::Description& robot);

/// The pose that the simulated rig really has: nominal · exp(rotation_error).
Eigen::Isometry3d trueBaseFromCamera(const robot::Description& robot, const CameraTruth& cameras);

}  // namespace capstan::simulation
