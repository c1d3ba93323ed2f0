#include "widgets/figures/joint_history.h"

#include <QObject>
#include <cmath>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

namespace {

using tracking::Gate;
using tracking::Snapshot;

float inScreenUnit(double value, int joint) { return static_cast<float>(tracking::forPeople(value, joint)); }

JointHistory::Row rowOf(const Snapshot& snapshot) {
  JointHistory::Row row;
  row.t = snapshot.t;
  row.occluded = tracking::markerLost(snapshot);
  for (int i = 0; i < JointHistory::kJoints; ++i)
    row.joint[static_cast<std::size_t>(i)] = {
        inScreenUnit(snapshot.q_link_true[i], i), inScreenUnit(snapshot.q_link_kin[i], i),
        inScreenUnit(snapshot.q_link_ukf[i], i), inScreenUnit(snapshot.q_link_ukf_sigma[i], i)};
  return row;
}

/// Whether a camera measured the joints in this step, accepted by the gate or not.
bool hasCameraPoint(const Snapshot& snapshot) {
  return snapshot.camera_updated && (snapshot.gate == Gate::kOpen || snapshot.gate == Gate::kJump) &&
         snapshot.q_link_cam.allFinite();
}

}  // namespace

bool widen(JointHistory::Row& low, JointHistory::Row& high, const JointHistory::Row& by) {
  bool wider = by.occluded ? !high.occluded : low.occluded;
  high.occluded = high.occluded || by.occluded;
  low.occluded = low.occluded && by.occluded;
  for (std::size_t i = 0; i < by.joint.size(); ++i) {
    JointValues &least = low.joint[i], &most = high.joint[i];
    const JointValues& value = by.joint[i];
    wider = widen(least.truth, most.truth, value.truth) || wider;
    wider = widen(least.kinematic, most.kinematic, value.kinematic) || wider;
    wider = widen(least.ukf, most.ukf, value.ukf) || wider;
    wider = widen(least.ukf_sigma, most.ukf_sigma, value.ukf_sigma) || wider;
  }
  return wider;
}

bool widen(JointHistory::CameraPoint& low, JointHistory::CameraPoint& high,
           const JointHistory::CameraPoint& by) {
  bool wider = false;
  for (std::size_t i = 0; i < by.value.size(); ++i)
    wider = widen(low.value[i], high.value[i], by.value[i]) || wider;
  return wider;
}

JointHistory::JointHistory(std::size_t rows, std::uint64_t reach, std::uint64_t camera_reach)
    : rows_(rows, reach), camera_(kCameraPoints, camera_reach), occluded_(kSpans) {}

std::size_t JointHistory::bytes() const {
  return rows_.bytes() + camera_.bytes() + occluded_.capacity() * sizeof(Span);
}

void JointHistory::clear() {
  rows_.clear();
  camera_.clear();
  occluded_.clear();
  occluded_now_ = own_kinematics_ = false;
}

QString JointHistory::referenceName() const {
  return own_kinematics_ ? QObject::tr("own kinematics") : nameOf(Quantity::kTrue);
}

void JointHistory::append(const Snapshot& snapshot) {
  if (!empty() && snapshot.t < end() - kSetBack) clear();
  if (!empty() && snapshot.t < end()) return;
  appendRow(snapshot);
  appendCamera(snapshot);
}

void JointHistory::appendRow(const Snapshot& snapshot) {
  if (!empty() && snapshot.t < end()) return;
  const Row row = rowOf(snapshot);
  own_kinematics_ = snapshot.own_kinematics;
  ++revision_;
  if (!empty() && snapshot.t == end())
    rows_.replaceNewest(row);
  else
    rows_.push(row);
  if (row.occluded && !occluded_now_) occluded_.push({snapshot.t, snapshot.t});
  if (row.occluded || occluded_now_) occluded_.back().end = snapshot.t;
  occluded_now_ = row.occluded;
}

void JointHistory::appendCamera(const Snapshot& snapshot) {
  if (!hasCameraPoint(snapshot) || (!camera_.empty() && snapshot.t_cam <= camera_.end())) return;
  ++revision_;
  CameraPoint point;
  point.t = snapshot.t_cam;
  for (int i = 0; i < kJoints; ++i)
    point.value[static_cast<std::size_t>(i)] = inScreenUnit(snapshot.q_link_cam[i], i);
  camera_.push(point);
}

std::optional<JointHistory::Row> JointHistory::at(double t) const {
  const Ring<Row>& rows = rows_.rows();
  if (rows.empty() || (t < detailBegin() && begin() < detailBegin())) return std::nullopt;
  const std::size_t after = rows.partitionPoint([&](const Row& row) { return row.t < t; });
  if (after == rows.size()) return rows.back();
  if (after == 0 || rows[after].t - t < t - rows[after - 1].t) return rows[after];
  return rows[after - 1];
}

std::optional<JointHistory::CameraPoint> JointHistory::cameraAt(double t, double reach) const {
  const Ring<CameraPoint>& camera = camera_.rows();
  if (camera.empty()) return std::nullopt;
  const std::size_t after = camera.partitionPoint([&](const CameraPoint& point) { return point.t < t; });
  std::optional<CameraPoint> best;
  for (const std::size_t i : {after, after - 1})
    if (i < camera.size() && std::abs(camera[i].t - t) <= reach &&
        (!best || std::abs(camera[i].t - t) < std::abs(best->t - t)))
      best = camera[i];
  return best;
}

}  // namespace capstan::widgets
