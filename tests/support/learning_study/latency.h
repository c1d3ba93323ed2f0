#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Prints the time per correction with and without σ, and the number of corrections per second in parallel,
/// with the full model.
void tellLatency(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
