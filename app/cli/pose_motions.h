#pragma once

#include <string>
#include <vector>

#include "core/learning/model/correction_file.h"
#include "core/learning/model/correction_model.h"
#include "core/learning/poses/pose_motion.h"

namespace capstan::cli {

/// Throws base::InputError if the model of the file is a rigid offset, which can neither drift nor learn.
void checkProcesses(const learning::CorrectionModel& model, const std::string& file);

/// Throws base::InputError if the model was trained on the motions of `files`: they would count twice, or
/// could not show drift.
void checkNew(const std::vector<std::string>& files, const learning::CorrectionSource& source);

/// Throws base::InputError if no pose of the file is near the learned poses.
void checkNear(const learning::CorrectionModel& model, const std::vector<learning::State>& states,
               const std::string& file);

}  // namespace capstan::cli
