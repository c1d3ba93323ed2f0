#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/robot/description.h"
#include "core/tracking/sample.h"

namespace capstan::studies {

/// Something that is wrong with a session: with the robot file that a filter is given, or with what motors
/// and cameras say.
struct Disturbance {
  std::string name;
  std::function<void(robot::Description&)> robot;                   ///< of the file; null: as it was
  std::function<void(tracking::Sample&, double duration)> samples;  ///< of `duration` [s]; null: as they were
};

/// Errors that a filter must live with, of a three-joint arm whose cameras see tips: cameras that are moved
/// or wrong, motors that slip, cable stiffness, friction and pulleys that the robot file has wrong. "None" is
/// the first.
std::vector<Disturbance> disturbances();

}  // namespace capstan::studies
