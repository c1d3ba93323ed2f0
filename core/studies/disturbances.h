#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/robot/description.h"
#include "core/tracking/sample.h"

namespace capstan::studies {

/// Disturbance of a session: an error in the filter's robot file, or in the samples of motors and cameras.
struct Disturbance {
  std::string name;
  std::function<void(robot::Description&)> robot;  ///< changes the robot file; null: no change
  /// Changes a sample of a session of `duration` [s]; null: no change.
  std::function<void(tracking::Sample&, double duration)> samples;
};

/// Disturbances that a filter must tolerate, for a three-joint arm whose cameras measure tips: moved or wrong
/// cameras, slipping motors, and wrong cable stiffness, friction and pulleys in the robot file. The first one
/// is "none".
std::vector<Disturbance> disturbances();

}  // namespace capstan::studies
