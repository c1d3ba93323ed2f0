#include "core/learning/model/trial_model.h"

#include <algorithm>

namespace capstan::learning {

CorrectionModel trialModel(const std::vector<State>& states, CorrectionOptions options,
                           base::Progress* progress, const base::ProgressPart& part) {
  options.calibrate = false;
  options.members = 1;
  options.likelihood_points = std::min(options.likelihood_points, kTrialPoints);
  options.inducing_points = std::min(options.inducing_points, kTrialPoints);
  return CorrectionModel::trained(states, options, progress, part);
}

std::vector<Vector6d> leftOf(const CorrectionModel& model, const std::vector<State>& states) {
  const std::vector<Eigen::Isometry3d> corrected = model.correct(states);
  std::vector<Vector6d> left(states.size());
  for (std::size_t k = 0; k < states.size(); ++k)
    left[k] = model.features().correction(corrected[k], states[k].pair.commanded);
  return left;
}

std::vector<double> sizesOf(const std::vector<Vector6d>& left, double lever) {
  std::vector<double> sizes;
  for (const Vector6d& one : left) sizes.push_back(one.head<3>().norm() + lever * one.tail<3>().norm());
  return sizes;
}

std::vector<Vector6d> leftByOthers(const std::vector<State>& states, const std::vector<bool>& counts,
                                   const CorrectionOptions& options, base::Progress* progress,
                                   const base::ProgressPart& part) {
  std::vector<std::size_t> fold = motionPlaces(states);
  for (std::size_t& place : fold) place %= kFolds;
  std::vector<Vector6d> found(states.size());
  for (std::size_t f = 0; f < kFolds; ++f) {
    std::vector<State> learned, held;
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (fold[k] == f) held.push_back(states[k]);
      if (fold[k] != f && counts[k]) learned.push_back(states[k]);
    }
    if (learned.size() < kFewestStates) return {};
    const double begin = static_cast<double>(f) / kFolds;
    const CorrectionModel model =
        trialModel(learned, options, progress, part.within(begin, begin + 1.0 / kFolds));
    if (progress && progress->cancelled()) return {};
    const std::vector<Vector6d> of_held = leftOf(model, held);
    for (std::size_t k = 0, h = 0; k < states.size(); ++k)
      if (fold[k] == f) found[k] = of_held[h++];
  }
  return found;
}

}  // namespace capstan::learning
