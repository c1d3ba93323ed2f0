#include "core/simulation/camera_mounting.h"

#include "core/robot/arm_kinematics.h"
#include "core/simulation/block_transfer.h"

namespace capstan::simulation {
namespace {

constexpr double kDistance = 0.5;        // distance from the peg board along the view [m]
constexpr double kHalfBaseline = 0.024;  // from the left camera to the middle of the rig [m]
constexpr double kStopShare = 0.35;      // image centre: share of the way from the board to the hard stop

}  // namespace

Eigen::Isometry3d nominalBaseFromCamera(const robot::Description& robot) {
  const PegBoard board = pegBoard(robot);
  const Eigen::Vector3d stop = robot::ArmKinematics(robot).tip(robot::homingOf(robot));

  const Eigen::Vector3d down = -board.up;
  const Eigen::Vector3d view = board.centre.dot(board.depth) > 0.0 ? -board.depth : board.depth;
  const Eigen::Vector3d right = down.cross(view);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right, down, view;

  const Eigen::Vector3d way = stop - board.centre;
  const Eigen::Vector3d aim = board.centre + kStopShare * (way - way.dot(view) * view);
  pose.translation() = aim - kDistance * view - kHalfBaseline * right;
  return pose;
}

Eigen::Isometry3d trueBaseFromCamera(const robot::Description& robot, const CameraTruth& cameras) {
  Eigen::Isometry3d pose = nominalBaseFromCamera(robot);
  const double angle = cameras.rotation_error.norm();
  if (angle > 0.0) pose.rotate(Eigen::AngleAxisd(angle, cameras.rotation_error / angle));
  return pose;
}

}  // namespace capstan::simulation
