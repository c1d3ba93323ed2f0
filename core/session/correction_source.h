#pragma once

#include <string>
#include <vector>

#include "core/learning/learn.h"
#include "core/session/correction_file.h"

namespace capstan::session {

/// The source of a model that learn() or learnMore() made from `tables`: what command line and window write
/// beside it. `before`: of the model that it was learned onto. base::InputError: a table cannot be read.
CorrectionSource correctionSource(const std::vector<std::string>& tables, learning::StreamKind towards,
                                  const learning::LearningReport& report, const std::string& software,
                                  CorrectionSource before = {});

}  // namespace capstan::session
