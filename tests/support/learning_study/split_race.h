#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Table I, towards the command and towards the robot's own kinematics, dirty and clean, with medians,
/// geodesic angles and how the stated σ hold; and the last row's means beside a plain scikit-learn process
/// (ARD-RBF, 1,500 training states, lag not taken off) on the same splits.
void raceSplits(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
