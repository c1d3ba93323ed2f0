#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/diagnosis/poses/pose_fit.h"
#include "core/diagnosis/report/report.h"

namespace capstan::diagnosis {

/// Compares the residual of the selected model with those of two regressions, for each axis of the tip, by
/// cross-validation over the trajectories of `data`: least squares on position and velocity of the reference
/// (seven terms), because a registration error is linear in the position, and residualProcess() of the
/// residual of this regression. `without`, `with`: residuals without effects and held-out residuals of the
/// selected model. `noise`: RMS per axis.
std::vector<Explainable> explainableOf(const PoseData& data, const Eigen::Matrix3Xd& without,
                                       const Eigen::Matrix3Xd& with, const Eigen::Vector3d& noise,
                                       const base::Progress* progress);

}  // namespace capstan::diagnosis
