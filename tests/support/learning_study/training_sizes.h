#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Figure 5: held-out error and time of training, all six outputs with hyperparameters, against the number of
/// states, on one split; and of all states the exact process, whose Cholesky factor is computed once.
void tellTrainingSizes(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
