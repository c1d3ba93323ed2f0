#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Compares speed with scikit-learn in the same run: one likelihood with gradient at 2,000 states, training
/// at 460 states to the same likelihood, and predictions with equal hyperparameters.
void raceProcesses(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
