#include "core/experiments/debridement_scene.h"

#include <algorithm>

#include "core/robot/tool_kinematics.h"
#include "core/simulation/trajectory.h"

namespace capstan::experiments {
namespace {

constexpr double kShortest = 0.1;  // shortest duration of a motion [s]

}  // namespace

Eigen::Isometry3d DebridementScene::pose(const Eigen::Vector3d& place, double yaw) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = grasping * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitX()).toRotationMatrix();
  pose.translation() = centre + axes * place;
  return pose;
}

DebridementScene debridementScene(const robot::Description& robot) {
  DebridementScene scene;
  scene.start = robot::JointVector::Zero(robot::kToolJoints);
  scene.start.head<3>() = simulation::BlockTransferSpec{}.board;
  const Eigen::Isometry3d middle = robot::ToolKinematics(robot).pose(scene.start);
  scene.centre = middle.translation();
  scene.grasping = middle.linear();
  const Eigen::Vector3d up = -robot.gravity.normalized();
  const Eigen::Vector3d lateral = up.unitOrthogonal();
  scene.axes << lateral, up.cross(lateral), up;
  return scene;
}

Fragment drawnFragment(base::Random& random, double margin, double most_yaw) {
  const double half = 0.5 * DebridementScene::kSide + margin;
  Fragment fragment;
  fragment.place = {random.uniform(-half, half), random.uniform(-half, half),
                    random.uniform(-margin, DebridementScene::kHeight + margin)};
  fragment.yaw = random.uniform(-most_yaw, most_yaw);
  return fragment;
}

std::vector<learning::Waypoint> straightMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to,
                                               double speed, int count) {
  const double way = (to.translation() - from.translation()).norm();
  const double rotation = Eigen::Quaterniond(from.linear()).angularDistance(Eigen::Quaterniond(to.linear()));
  const double lasts = std::max({way / speed, rotation / kRotationRate, kShortest});
  std::vector<learning::Waypoint> motion;
  for (int k = 0; k < count; ++k) {
    const double share = static_cast<double>(k) / (count - 1);
    motion.push_back({share * lasts, learning::poseBetween(from, to, share)});
  }
  return motion;
}

}  // namespace capstan::experiments
