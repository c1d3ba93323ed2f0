#pragma once

#include <string>
#include <vector>

#include "core/learning/model/correction_file.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/pose_motion.h"

namespace capstan::cli {

/// base::InputError: the model of the file is a rigid offset alone, which can neither drift nor learn.
void checkProcesses(const learning::CorrectionModel& model, const std::string& file);

/// base::InputError: motions that the model was trained on already: they would count twice, or say nothing
/// about drift.
void checkNew(const std::vector<std::string>& files, const learning::CorrectionSource& source);

/// base::InputError: no pose of the file is anywhere near what was learned.
void checkNear(const learning::CorrectionModel& model, const std::vector<learning::State>& states,
               const std::string& file);

}  // namespace capstan::cli
