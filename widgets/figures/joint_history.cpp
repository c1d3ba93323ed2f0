#include "widgets/figures/joint_history.h"

#include <cmath>

#include "core/base/units.h"

namespace capstan::widgets {

namespace {

using tracking::Gate;
using tracking::Snapshot;

float inScreenUnit(double value, int joint) {
  const bool length = tracking::kJointUnits[static_cast<std::size_t>(joint)][0] == 'm';
  return static_cast<float>(length ? base::toMillimetres(value) : base::toDegrees(value));
}

JointHistory::Row rowOf(const Snapshot& snapshot) {
  JointHistory::Row row;
  row.t = snapshot.t;
  for (int i = 0; i < JointHistory::kJoints; ++i)
    row.joint[static_cast<std::size_t>(i)] = {
        inScreenUnit(snapshot.q_link_true[i], i), inScreenUnit(snapshot.q_link_kin[i], i),
        inScreenUnit(snapshot.q_link_ukf[i], i), inScreenUnit(snapshot.q_link_ukf_sigma[i], i)};
  return row;
}

/// A camera measured the joints in this step, whether or not the gate let it through.
bool hasCameraPoint(const Snapshot& snapshot) {
  return snapshot.camera_updated && (snapshot.gate == Gate::kOpen || snapshot.gate == Gate::kJump) &&
         snapshot.q_link_cam.allFinite();
}

void widen(JointValues& low, JointValues& high, const JointValues& by) {
  const auto one = [](float& least, float& most, float value) {
    least = std::fmin(least, value);  // fmin and fmax pass over NaN
    most = std::fmax(most, value);
  };
  one(low.truth, high.truth, by.truth);
  one(low.kinematic, high.kinematic, by.kinematic);
  one(low.ukf, high.ukf, by.ukf);
  one(low.ukf_sigma, high.ukf_sigma, by.ukf_sigma);
}

}  // namespace

JointHistory::JointHistory(std::size_t rows) : rows_(rows), camera_(kCameraPoints), occluded_(kSpans) {
  for (std::size_t size = rows / 4; size >= 256; size /= 4) levels_.emplace_back(size);
  if (levels_.empty()) levels_.emplace_back(std::max<std::size_t>(rows / 4, 1));
}

void JointHistory::clear() {
  rows_.clear();
  for (auto& level : levels_) level.clear();
  camera_.clear();
  occluded_.clear();
  occluded_now_ = false;
}

void JointHistory::append(const Snapshot& snapshot) {
  if (!rows_.empty() && snapshot.t < rows_.back().t - kSetBack) clear();
  if (!rows_.empty() && snapshot.t < rows_.back().t) return;
  const Row row = rowOf(snapshot);
  if (!rows_.empty() && snapshot.t == rows_.back().t) {
    rows_.back() = row;
    for (auto& level : levels_)
      for (std::size_t i = 0; i < kJoints; ++i)
        widen(level.back().low[i], level.back().high[i], row.joint[i]);
  } else {
    rows_.push(row);
    fold(row);
  }
  if (hasCameraPoint(snapshot) && (camera_.empty() || snapshot.t_cam > camera_.back().t)) {
    CameraPoint point;
    point.t = snapshot.t_cam;
    for (int i = 0; i < kJoints; ++i)
      point.value[static_cast<std::size_t>(i)] = inScreenUnit(snapshot.q_link_cam[i], i);
    camera_.push(point);
  }
  const bool occluded = tracking::markerLost(snapshot);
  if (occluded && !occluded_now_) occluded_.push({snapshot.t, snapshot.t});
  if (occluded || occluded_now_) occluded_.back().end = snapshot.t;
  occluded_now_ = occluded;
}

void JointHistory::fold(const Row& row) {
  const std::uint64_t index = rows_.pushed() - 1;
  std::uint64_t rows_a_bucket = 4;
  for (auto& level : levels_) {
    if (index % rows_a_bucket == 0)
      level.push({row.t, row.joint, row.joint});
    else
      for (std::size_t i = 0; i < kJoints; ++i)
        widen(level.back().low[i], level.back().high[i], row.joint[i]);
    rows_a_bucket *= 4;
  }
}

std::optional<JointHistory::Row> JointHistory::at(double t) const {
  if (rows_.empty()) return std::nullopt;
  const std::size_t after = rows_.partitionPoint([&](const Row& row) { return row.t < t; });
  if (after == rows_.size()) return rows_.back();
  if (after == 0 || rows_[after].t - t < t - rows_[after - 1].t) return rows_[after];
  return rows_[after - 1];
}

std::optional<JointHistory::CameraPoint> JointHistory::cameraAt(double t, double reach) const {
  if (camera_.empty()) return std::nullopt;
  const std::size_t after = camera_.partitionPoint([&](const CameraPoint& point) { return point.t < t; });
  std::optional<CameraPoint> best;
  for (const std::size_t i : {after, after - 1})
    if (i < camera_.size() && std::abs(camera_[i].t - t) <= reach &&
        (!best || std::abs(camera_[i].t - t) < std::abs(best->t - t)))
      best = camera_[i];
  return best;
}

}  // namespace capstan::widgets
