#include "core/identification/model_error.h"

#include "core/identification/shooting.h"

namespace capstan::identification {

std::optional<ModelError> modelErrorOf(const IdentificationData& data, const ParameterSet& set,
                                       const std::vector<Estimate>& estimates,
                                       const base::Progress* progress) {
  const Shooting shooting(data, set, {.segment = 20.0, .threads = 1});
  if (shooting.used().empty()) return std::nullopt;
  ParameterSet::Logs logs = ParameterSet::Logs::Zero(set.size());
  const auto rmsAt = [&](Eigen::Vector3d& rms) {
    std::vector<ArmPrediction> predictions;
    if (!shooting.predict(logs, false, predictions, progress)) return false;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < predictions.size(); ++k)
      sum += (data.cameras[shooting.used()[k]].q_cam - predictions[k].q).cwiseAbs2();
    rms = (sum / static_cast<double>(predictions.size())).cwiseSqrt();
    return true;
  };
  ModelError error;
  error.observations = static_cast<int>(shooting.used().size());
  if (!rmsAt(error.before)) return std::nullopt;
  for (int i = 0; i < set.size(); ++i) {
    const Estimate& estimate = estimates[static_cast<std::size_t>(i)];
    if (estimate.seen) logs(i) = estimate.log;
  }
  if (!rmsAt(error.after)) return std::nullopt;
  return error;
}

}  // namespace capstan::identification
