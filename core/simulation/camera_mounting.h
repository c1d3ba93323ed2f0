#pragma once

#include <Eigen/Geometry>

#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::simulation {

/// Nominal pose of the left camera in frame 0. The rig is fixed to the base, its axes parallel to those of
/// the base: the image's downward axis is the direction of gravity, and the optical axis is horizontal along
/// the y axis of frame 0, from the side on which the tool works. The rig is half a metre from the
/// block-transfer board and looks at a point between board and hard stop. For the left arm the camera axes x,
/// y, z are −z, −x, +y of frame 0. The rotation is known by construction (UKF paper, section II-A);
/// registration finds the translation.
Eigen::Isometry3d nominalBaseFromCamera(const robot::Description& robot);

/// True pose of the left camera in frame 0: nominal · exp(rotation_error).
Eigen::Isometry3d trueBaseFromCamera(const robot::Description& robot, const CameraTruth& cameras);

}  // namespace capstan::simulation
