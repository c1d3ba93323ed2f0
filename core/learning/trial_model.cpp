#include "core/learning/trial_model.h"

#include <algorithm>

namespace capstan::learning {

CorrectionModel trialModel(const std::vector<State>& states, CorrectionOptions options,
                           base::Progress* progress, const base::ProgressPart& part) {
  options.calibrate = false;
  options.likelihood_points = std::min(options.likelihood_points, kTrialPoints);
  options.inducing_points = std::min(options.inducing_points, kTrialPoints);
  return CorrectionModel::trained(states, options, progress, part);
}

std::vector<double> leftOf(const CorrectionModel& model, const std::vector<State>& states, double lever) {
  const std::vector<Eigen::Isometry3d> corrected = model.correct(states);
  std::vector<double> left;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const Eigen::Isometry3d off = corrected[k].inverse() * states[k].pair.told;
    left.push_back(off.translation().norm() + lever * Eigen::AngleAxisd(off.linear()).angle());
  }
  return left;
}

}  // namespace capstan::learning
