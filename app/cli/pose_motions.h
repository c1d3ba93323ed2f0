#pragma once

#include <string>
#include <vector>

#include "core/learning/pose_motion.h"

namespace capstan::cli {

/// The motions of tables of tip poses; of several tables each motion carries the name of its own.
std::vector<learning::RawMotion> readMotions(const std::vector<std::string>& files);

/// base::InputError: a table is given twice.
void checkDistinct(const std::vector<std::string>& files);

}  // namespace capstan::cli
