#pragma once

#include <string>
#include <vector>

#include "core/learning/model/correction_file.h"
#include "core/learning/model/learn.h"

namespace capstan::learning {

/// The source of a model that learn() or learnMore() made from `tables`: what command line and window write
/// beside it. `before`: of the model that it was learned onto. base::InputError: a table cannot be read.
CorrectionSource correctionSource(const std::vector<std::string>& tables, learning::StreamKind towards,
                                  const learning::LearningReport& report, const std::string& software,
                                  CorrectionSource before = {});

}  // namespace capstan::learning
