#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "core/robot/description.h"

namespace capstan::robot {

/// Throws base::InputError when the robot of a file cannot have the effects in the file: the name is unknown
/// (the nearest name is proposed), the drive cannot have the effect, the joint does not exist, a number is
/// missing, unknown or out of its bounds, a joint has one law twice, or the effects together make the
/// coupling or the mass matrix singular. `root` is the root node of the file, for the line numbers in errors.
void checkEffects(const YAML::Node& root, const std::string& file, const Description& description);

}  // namespace capstan::robot
