#pragma once

#include "tests/support/learning_study/learning_data.h"

namespace capstan::study {

/// Prints Table I towards the command and towards the robot's kinematics, with and without outliers, with
/// medians, geodesic angles and the coverage of the predicted σ. The means of the last row are compared with
/// a plain scikit-learn process (ARD-RBF, 1,500 training states, clock offset not removed) on the same
/// splits.
void raceSplits(const LearningData& data, const LearningStudyOptions& options);

}  // namespace capstan::study
