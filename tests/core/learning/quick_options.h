#pragma once

#include "core/learning/model/correction_model.h"

namespace capstan::learning {

/// Enough to learn a few hundred states in a second.
inline CorrectionOptions quickOptions(Eigen::Index likelihood_points = 150) {
  CorrectionOptions options;
  options.likelihood_points = likelihood_points;
  options.inducing_points = 150;
  return options;
}

}  // namespace capstan::learning
