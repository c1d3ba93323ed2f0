#pragma once

#include <ceres/ceres.h>

#include "core/base/progress.h"
#include "core/identification/batch.h"

namespace capstan::identification {

/// How a run of Ceres ended; `progress` may be null.
inline BatchEnd endOf(const ceres::Solver::Summary& summary, const base::Progress* progress) {
  if (progress && progress->cancelled()) return BatchEnd::kCancelled;
  if (summary.termination_type == ceres::CONVERGENCE) return BatchEnd::kConverged;
  return summary.termination_type == ceres::NO_CONVERGENCE ? BatchEnd::kIterationLimit : BatchEnd::kFailed;
}

}  // namespace capstan::identification
