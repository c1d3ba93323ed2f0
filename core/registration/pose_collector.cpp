#include "core/registration/pose_collector.h"

#include <array>
#include <limits>

#include "core/base/yaml.h"
#include "core/registration/registration_difference.h"
#include "core/robot/arm_kinematics.h"
#include "core/robot/transmission.h"
#include "core/stats/quantile.h"
#include "core/table_files/write_columns.h"

namespace capstan::registration {

bool PoseCollector::isNew(const Eigen::Vector3d& tip, const std::vector<CollectedPose>& poses) const {
  return std::ranges::all_of(
      poses, [&](const CollectedPose& pose) { return (pose.pair.base - tip).norm() >= kApart; });
}

bool PoseCollector::observe(const tracking::Snapshot& snapshot) {
  if (!snapshot.camera_updated || !snapshot.tip_kin_cam.allFinite()) return false;
  const bool slow = speed_.to(snapshot) <= kSlow;  // false for the first sample: NaN
  if (!slow || !snapshot.tip_in_camera.allFinite() || !(collecting_ || checking_)) return false;
  std::vector<CollectedPose>& into = checking_ ? checks_ : poses_;
  if (!isNew(snapshot.tip_kin_cam, into)) return false;
  into.push_back({snapshot.t_cam,
                  {snapshot.tip_in_camera, snapshot.tip_kin_cam},
                  snapshot.q_link_kin,
                  std::sqrt(snapshot.tip_in_camera_covariance.trace())});
  if (checking_ && checks_.size() == kChecks) checking_ = false;
  if (poses_.size() == kMost) collecting_ = false;
  if (&into == &poses_) refit();
  return true;
}

void PoseCollector::exclude(std::size_t pose, bool excluded) {
  poses_[pose].excluded = excluded;
  refit();
}

void PoseCollector::clear() {
  stop();
  poses_.clear();
  checks_.clear();
  refit();
}

void PoseCollector::setRobot(const robot::Description& robot) {
  const robot::Transmission before(robot_), now(robot);
  const robot::ArmKinematics arm_before(robot_), arm_now(robot);
  for (auto* poses : {&poses_, &checks_})
    for (CollectedPose& pose : *poses) {
      const Eigen::Vector3d q = now.jointFromMotor(before.motorFromJoint(pose.q));
      pose.pair.base += arm_now.tip(q) - arm_before.tip(pose.q);
      pose.q = q;
    }
  robot_ = robot;
  refit();
}

double PoseCollector::rmsBy(const Eigen::Isometry3d& base_from_camera) const {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < fitted_.size(); ++i) {
    if (!fit_->used[i]) continue;
    const PointPair& pair = poses_[fitted_[i]].pair;
    sum += (base_from_camera * pair.camera - pair.base).squaredNorm();
    count += 1.0;
  }
  return std::sqrt(sum / count);
}

void PoseCollector::check() {
  collecting_ = false;
  checks_.clear();
  checking_ = true;
}

void PoseCollector::refit() {
  std::vector<PointPair> pairs;
  fitted_.clear();
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    if (poses_[i].excluded) continue;
    pairs.push_back(poses_[i].pair);
    fitted_.push_back(i);
  }
  fit_ = registerPairs(pairs);
}

WorkspaceError PoseCollector::workspaceError() const {
  const Eigen::Isometry3d camera_from_base = fit_->base_from_camera.inverse();
  std::vector<double> errors;
  for (const Eigen::Vector3d& tip : workspaceTips(robot_))
    errors.push_back(error95At(*fit_, camera_from_base * tip));
  return {stats::median(errors), *std::ranges::max_element(errors)};
}

void PoseCollector::save(const std::filesystem::path& path) const {
  constexpr std::array names = {"t", "x", "y", "z", "cam_x", "cam_y", "cam_z", "excluded"};
  std::array<std::vector<double>, names.size()> columns;
  for (const CollectedPose& pose : poses_) {
    const std::array<double, names.size()> row = {pose.t,
                                                  pose.pair.base.x(),
                                                  pose.pair.base.y(),
                                                  pose.pair.base.z(),
                                                  pose.pair.camera.x(),
                                                  pose.pair.camera.y(),
                                                  pose.pair.camera.z(),
                                                  pose.excluded ? 1.0 : 0.0};
    for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  }
  std::vector<table_files::NamedColumn> table;
  for (std::size_t i = 0; i < names.size(); ++i) table.push_back({names[i], {}, {}, &columns[i]});
  base::writeTextFile(path, table_files::formatCsv(table));
}

}  // namespace capstan::registration
