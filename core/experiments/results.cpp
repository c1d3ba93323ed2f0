#include "core/experiments/results.h"

#include <cctype>
#include <cmath>

namespace capstan::experiments {

std::vector<double> TrialResult::errorsOf(Estimator which, int joint) const {
  std::vector<double> values;
  const auto add = [&](const Eigen::Vector3d& error) {
    if (error.allFinite()) values.push_back(error(joint));
  };
  if (which == Estimator::kCamera)
    for (const CameraPoint& point : camera) add(point.error);
  else
    for (const ErrorPoint& point : errors)
      add(which == Estimator::kKinematic    ? point.kinematic
          : which == Estimator::kIdentified ? point.identified
                                            : point.ukf);
  return values;
}

std::vector<double> TrialResult::absoluteErrors(Estimator which, int joint) const {
  std::vector<double> values = errorsOf(which, joint);
  for (double& value : values) value = std::abs(value);
  return values;
}

std::string fileNameOf(const std::string& text) {
  std::string name;
  for (const unsigned char c : text) {
    if (std::isalnum(c) != 0 || c == '_')
      name += static_cast<char>(c);
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (!name.empty() && name.back() == '-') name.pop_back();
  return name.empty() ? "trial" : name;
}

}  // namespace capstan::experiments
