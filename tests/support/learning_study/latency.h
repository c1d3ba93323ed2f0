#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// How long one command takes, with and without its σ, and how many a second side by side, full model.
void tellLatency(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
