#pragma once

#include "core/robot/description.h"
#include "core/simulation/truth.h"

namespace capstan::studies {

/// `robot` with the effective pulley radii of `truth`. Estimators of a study assume it where a wrong radius
/// would hide the effect under study.
inline robot::Description withTrueRadii(robot::Description robot, const simulation::Truth& truth) {
  for (std::size_t joint = 0; joint < 3; ++joint)
    robot.drives[joint].link_radius =
        truth.joints[joint].link_radius.value_or(robot.drives[joint].link_radius);
  return robot;
}

}  // namespace capstan::studies
