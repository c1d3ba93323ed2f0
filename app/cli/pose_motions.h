#pragma once

#include <string>
#include <vector>

#include "core/learning/correction_model.h"
#include "core/learning/pose_motion.h"

namespace capstan::cli {

/// The motions of tables of tip poses; of several tables each motion carries the name of its own.
/// base::InputError as readPoseTable() and learning::checkTable().
std::vector<learning::RawMotion> readMotions(const std::vector<std::string>& files,
                                             learning::StreamKind towards);

/// base::InputError: the model of the file is a rigid offset alone, which neither ages nor takes anything in.
void checkProcesses(const learning::CorrectionModel& model, const std::string& file);

/// base::InputError: a table is given twice.
void checkDistinct(const std::vector<std::string>& files);

}  // namespace capstan::cli
