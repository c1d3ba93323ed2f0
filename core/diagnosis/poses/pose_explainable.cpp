#include "core/diagnosis/poses/pose_explainable.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/diagnosis/poses/pose_channels.h"
#include "core/diagnosis/selection/explainable.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;

/// A constant, and position and velocity of the reference at each observation.
struct Regressors {
  MatrixXd x;
  std::vector<std::string> names;
};

Regressors regressorsOf(const std::vector<Variable>& variables, Index observations) {
  Regressors all{MatrixXd::Ones(observations, 1), {}};
  for (const Variable& one : variables) {
    if (one.kind != VariableKind::kPosition && one.kind != VariableKind::kVelocity) continue;
    all.x.conservativeResize(observations, all.x.cols() + 1);
    all.x.rightCols(1) = Eigen::Map<const Eigen::VectorXd>(one.values.data(), observations);
    all.names.push_back(one.name);
  }
  return all;
}

std::vector<int> foldsOf(const PoseData& data) {
  std::vector<int> fold;
  for (Index k = 0; k < data.blocks(); ++k)
    fold.insert(fold.end(), static_cast<std::size_t>(data.count(k)), static_cast<int>(k % kFolds));
  return fold;
}

double meanSquare(const Matrix3Xd& e, int axis) {
  return e.row(axis).squaredNorm() / static_cast<double>(std::max<Index>(1, e.cols()));
}

}  // namespace

std::vector<Explainable> explainableOf(const PoseData& data, const Matrix3Xd& without, const Matrix3Xd& with,
                                       const Eigen::Vector3d& noise, const base::Progress* progress) {
  const std::vector<Variable> variables = poseVariables(data);
  const auto [x, names] = regressorsOf(variables, data.observations());
  const std::vector<int> fold = foldsOf(data);
  std::vector<Explainable> channels;
  const MatrixXd weights = x.colPivHouseholderQr().solve(without.transpose());
  const Matrix3Xd nonlinear = without - (x * weights).transpose();
  for (int axis = 0; axis < 3; ++axis) {
    const Channel channel = poseChannel(data, nonlinear, axis, noise);
    const MeasuredRegression linear{heldOutSquare(x, without.row(axis).transpose(), fold), names};
    channels.push_back(explainableFrom(channel, meanSquare(without, axis), meanSquare(with, axis), linear,
                                       linear.mean_square,
                                       residualProcess(channel, variables, {.shuffles = 2}, progress)));
  }
  const auto beyond = [](const Explainable& one) { return one.refitted / std::max(one.noise, 1e-12); };
  std::ranges::stable_sort(channels, std::greater<>(), beyond);
  return channels;
}

}  // namespace capstan::diagnosis
