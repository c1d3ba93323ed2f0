#pragma once

#include <string>
#include <vector>

#include "core/learning/model/correction_file.h"
#include "core/learning/model/learn.h"

namespace capstan::learning {

/// Source of a model that learn() or learnMore() learned from `tables`. Command line and window write it into
/// the model's file. `before`: source of the model to which learnMore() added. Throws base::InputError if a
/// table cannot be read.
CorrectionSource correctionSource(const std::vector<std::string>& tables, learning::StreamKind towards,
                                  const learning::LearningReport& report, const std::string& software,
                                  CorrectionSource before = {});

}  // namespace capstan::learning
