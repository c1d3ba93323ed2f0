#include "core/learning/evaluation/correction_errors.h"

#include <cmath>
#include <numeric>

#include "core/learning/poses/pose_features.h"
#include "core/stats/quantile.h"

namespace capstan::learning {

using learning::Vector6d;

namespace {

double meanOf(const std::vector<double>& x) {
  return x.empty() ? 0.0 : std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size());
}

}  // namespace

void PoseErrors::add(const Eigen::Isometry3d& corrected, const Eigen::Isometry3d& commanded) {
  const learning::PoseFeatures angles(learning::RotationForm::kYawPitchRoll, learning::Motion::kNone,
                                      Eigen::Quaterniond::Identity());
  const Eigen::Isometry3d from_middle(middle.conjugate());
  Vector6d off = angles.correction(from_middle * corrected, from_middle * commanded);
  off.head<3>() = commanded.translation() - corrected.translation();
  apart.push_back(off.cwiseAbs());
  distance.push_back((corrected.translation() - commanded.translation()).norm());
  angle.push_back(
      Eigen::Quaterniond(corrected.linear()).angularDistance(Eigen::Quaterniond(commanded.linear())));
}

void PoseErrors::add(const PoseErrors& other) {
  apart.insert(apart.end(), other.apart.begin(), other.apart.end());
  distance.insert(distance.end(), other.distance.begin(), other.distance.end());
  angle.insert(angle.end(), other.angle.begin(), other.angle.end());
}

std::vector<double> PoseErrors::along(Eigen::Index degree) const {
  std::vector<double> one;
  one.reserve(apart.size());
  for (const Vector6d& errors : apart) one.push_back(errors[degree]);
  return one;
}

CorrectionErrors PoseErrors::summed() const {
  CorrectionErrors errors;
  errors.states = apart.size();
  for (Eigen::Index k = 0; k < 6; ++k) {
    std::vector<double> one = along(k);
    errors.mean[k] = meanOf(one);
    errors.median[k] = stats::median(one);
    for (double& x : one) x = std::pow(x - errors.mean[k], 2);
    errors.deviation[k] = std::sqrt(meanOf(one));
  }
  errors.distance = meanOf(distance);
  errors.median_distance = stats::median(distance);
  errors.angle = meanOf(angle);
  errors.median_angle = stats::median(angle);
  return errors;
}

Eigen::Quaterniond middleCommandOf(const std::vector<learning::State>& states) {
  std::vector<Eigen::Isometry3d> commanded;
  for (const learning::State& state : states) commanded.push_back(state.pair.commanded);
  return learning::meanRotation(commanded);
}

}  // namespace capstan::learning
