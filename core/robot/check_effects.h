#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

#include "core/robot/description.h"

namespace capstan::robot {

/// Throws base::InputError where the effects of a robot file cannot be in its robot: an unknown name (the
/// nearest is proposed), a drive that cannot have it, a joint that is not there, a number that is missing,
/// unknown or out of its bounds, one law twice at a joint, and together a coupling or a mass matrix that
/// cannot be inverted. `root` is the file whose lines are named.
void checkEffects(const YAML::Node& root, const std::string& file, const Description& description);

}  // namespace capstan::robot
