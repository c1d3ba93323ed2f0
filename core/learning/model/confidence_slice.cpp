#include "core/learning/model/confidence_slice.h"

#include <algorithm>
#include <cmath>

namespace capstan::learning {
namespace {

/// Training positions, transformed by the offset.
struct Moved {
  std::vector<Eigen::Isometry3d> poses;
  Eigen::AlignedBox3d box;

  Moved(const CorrectionModel& model, const std::vector<State>& learned) {
    for (const State& state : learned) {
      poses.push_back(model.offset() * state.pair.observed);
      box.extend(poses.back().translation());
    }
  }
};

ConfidenceSlice planeOf(const Moved& moved, const SliceOptions& options) {
  ConfidenceSlice slice;
  slice.axis = options.axis;
  slice.right = options.axis == 0 ? 1 : 0;
  slice.up = options.axis == 2 ? 1 : 2;
  const Eigen::Vector3d low = moved.box.min(), high = moved.box.max();
  slice.at = low[slice.axis] + options.depth * (high[slice.axis] - low[slice.axis]);
  slice.low = {low[slice.right] - options.margin, low[slice.up] - options.margin};
  slice.high = {high[slice.right] + options.margin, high[slice.up] + options.margin};
  const Eigen::Vector2d side = slice.high - slice.low;
  const double step = side.maxCoeff() / std::max(options.cells - 1, 1);
  slice.confidence = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(std::lround(side[1] / step)) + 1,
                                           static_cast<Eigen::Index>(std::lround(side[0] / step)) + 1);
  for (const Eigen::Isometry3d& pose : moved.poses)
    if (std::abs(pose.translation()[slice.axis] - slice.at) <= slice.near)
      slice.learned.emplace_back(pose.translation()[slice.right], pose.translation()[slice.up]);
  return slice;
}

}  // namespace

ConfidenceSlice confidenceSlice(const CorrectionModel& model, const std::vector<State>& learned,
                                const SliceOptions& options, base::Progress* progress) {
  const Moved moved(model, learned);
  if (moved.poses.empty()) return {};
  ConfidenceSlice slice = planeOf(moved, options);
  State state;
  Eigen::Isometry3d commanded = Eigen::Isometry3d::Identity();
  commanded.linear() = meanRotation(moved.poses).toRotationMatrix();
  const Eigen::Isometry3d observed_from_commanded = model.offset().inverse();
  const Eigen::Vector2d step =
      (slice.high - slice.low)
          .cwiseQuotient(Eigen::Vector2d(static_cast<double>(slice.confidence.cols() - 1),
                                         static_cast<double>(slice.confidence.rows() - 1))
                             .cwiseMax(1.0));
  for (Eigen::Index row = 0; row < slice.confidence.rows(); ++row) {
    if (progress)
      progress->report(static_cast<double>(row) / static_cast<double>(slice.confidence.rows()), "confidence");
    if (progress && progress->cancelled()) {
      slice.cancelled = true;
      return slice;
    }
    std::vector<State> line;
    for (Eigen::Index column = 0; column < slice.confidence.cols(); ++column) {
      commanded.translation()[slice.axis] = slice.at;
      commanded.translation()[slice.right] = slice.low[0] + static_cast<double>(column) * step[0];
      commanded.translation()[slice.up] = slice.low[1] + static_cast<double>(row) * step[1];
      state.pair.observed = observed_from_commanded * commanded;
      line.push_back(state);
    }
    slice.confidence.row(row) = model.confidence(line).transpose();
  }
  return slice;
}

}  // namespace capstan::learning
