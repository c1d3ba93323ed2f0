#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Prints Figure 5: held-out error and training time (six outputs, with hyperparameters) against the number
/// of states, on one split, and the same for the exact process of all states, whose Cholesky factor is
/// computed once.
void tellTrainingSizes(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
