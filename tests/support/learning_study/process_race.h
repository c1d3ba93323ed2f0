#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// One likelihood with gradient at 2,000 states, training at 460 to the same likelihood, and predictions at
/// equal hyperparameters, beside scikit-learn in the same run.
void raceProcesses(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
