#include "core/diagnosis/poses/pose_channels.h"

#include <fmt/format.h>

#include "core/diagnosis/evidence/channel_noise.h"
#include "core/stats/quantile.h"

namespace capstan::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;

std::vector<double> rowOf(const Matrix3Xd& values, int axis) {
  std::vector<double> row(static_cast<std::size_t>(values.cols()));
  for (Index i = 0; i < values.cols(); ++i) row[static_cast<std::size_t>(i)] = values(axis, i);
  return row;
}

/// Times of all observations, which increase over all trajectories [s].
std::vector<double> timesOf(const PoseData& data) {
  std::vector<double> t;
  double begin = 0.0;
  for (const PoseMotion& motion : data.motions()) {
    for (const double observed : motion.t_seen) t.push_back(begin + observed - motion.t_seen.front());
    begin = t.back() + kApart;
  }
  return t;
}

/// Positions of the reference path `late` seconds before each observation, 3 × observations [m].
Matrix3Xd pathAt(const PoseData& data, double late) {
  PoseNumbers numbers;
  numbers.camera.delay = late;
  Matrix3Xd path(3, data.observations());
  for (Index k = 0; k < data.blocks(); ++k)
    path.middleCols(data.first(k), data.count(k)) =
        seenBy(numbers, data.motions()[static_cast<std::size_t>(k)]);
  return path;
}

}  // namespace

Eigen::Vector3d noiseOf(const PoseData& data, const Matrix3Xd& e) {
  Eigen::Vector3d noise;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> all = rowOf(e, axis);
    std::vector<double> each;
    for (Index k = 0; k < data.blocks(); ++k) {
      const double sigma = whiteNoise({all.data() + data.first(k), static_cast<std::size_t>(data.count(k))});
      if (sigma > 0.0) each.push_back(sigma);
    }
    noise[axis] = each.empty() ? 0.0 : stats::median(each);
  }
  return noise;
}

ComparedChannel comparedChannel(int axis, const Eigen::Vector3d& noise) {
  return {fmt::format("tip {}", "xyz"[axis]), "m", 0, axis, noise[axis]};
}

Channel poseChannel(const PoseData& data, const Matrix3Xd& e, int axis, const Eigen::Vector3d& noise) {
  const ComparedChannel compared = comparedChannel(axis, noise);
  Channel channel;
  channel.name = compared.name;
  channel.unit = compared.unit;
  channel.axis = axis;
  channel.noise = compared.noise;
  channel.t = timesOf(data);
  channel.residual = rowOf(e, axis);
  for (const PoseMotion& motion : data.motions())
    for (Index i = 0; i < motion.observed.cols(); ++i) channel.measured.push_back(motion.observed(axis, i));
  std::vector<double> periods;
  for (std::size_t i = 0; i < channel.t.size(); ++i) {
    channel.row.push_back(static_cast<double>(i));
    channel.simulated.push_back(channel.measured[i] - channel.residual[i]);
    if (i > 0) periods.push_back(channel.t[i] - channel.t[i - 1]);
  }
  channel.period = periods.empty() ? 0.0 : stats::median(periods);
  return channel;
}

std::vector<Variable> poseVariables(const PoseData& data) {
  const Matrix3Xd path = pathAt(data, 0.0);
  const Matrix3Xd velocity = (pathAt(data, -0.5 * kSlope) - pathAt(data, 0.5 * kSlope)) / kSlope;
  std::vector<Variable> variables;
  for (int axis = 0; axis < 3; ++axis) {
    const std::string tip = fmt::format("tip {}", "xyz"[axis]);
    const std::vector<double> speed = rowOf(velocity, axis);
    std::vector<double> direction;
    for (const double v : speed) direction.push_back(v > kResting ? 1.0 : v < -kResting ? -1.0 : 0.0);
    variables.push_back({VariableKind::kPosition, 0, "position of " + tip, "m", 0.0, rowOf(path, axis)});
    variables.push_back({VariableKind::kVelocity, 0, "velocity of " + tip, "m/s", 0.0, speed});
    variables.push_back({VariableKind::kDirection, 0, "direction of " + tip, "", 0.0, std::move(direction)});
  }
  variables.push_back({VariableKind::kTime, 0, "time", "s", 0.0, timesOf(data)});
  return variables;
}

}  // namespace capstan::diagnosis
