#include <gtest/gtest.h>

#include "tests/widgets/scene_snapshot.h"
#include "widgets/scene/arm_shape.h"
#include "widgets/scene/workspace_grid.h"

namespace capstan::widgets {
namespace {

using Eigen::Vector3d;

TEST(ArmShape, LinksMeetAtTheJointsInEveryPose) {
  const auto robot = test::leftArm();
  const robot::ArmKinematics arm(robot);
  const ArmShape shape = shapeOf(robot);
  for (const Vector3d& q : {Vector3d(0.0, 1.0, 0.3), Vector3d(0.7, 1.5, 0.4), Vector3d(1.5, 2.3, 0.55)}) {
    const auto end = [&](const Tube& tube, bool last) {
      return Vector3d(arm.frame(tube.frame, q) * (last ? tube.path.back() : tube.path.front()));
    };
    const Tube &base = shape.links[0], &first = shape.links[1], &second = shape.links[2],
               &rail = shape.links[3];
    EXPECT_LT((end(base, false) - end(first, false)).norm(), 1e-9);
    EXPECT_LT((end(first, true) - end(second, false)).norm(), 1e-9) << "joint 2";
    const Vector3d along = (end(rail, true) - end(rail, false)).normalized();
    EXPECT_LT(along.cross(end(second, true)).norm(), 1e-9) << "the second arc ends on the rail";
    const Vector3d carriage = arm.frame(3, q).translation();
    EXPECT_LT(along.cross(carriage).norm(), 1e-9) << "the third joint slides along the rail";
    EXPECT_LT((end(shape.shaft[0], true) - arm.tip(q)).norm(), 1e-9) << "the shaft ends in the marker";
  }
}

TEST(ArmShape, ArcsPassTheLinksCentresOfMass) {
  const auto robot = test::leftArm();
  const ArmShape shape = shapeOf(robot);
  for (int i = 0; i < 2; ++i) {
    const Vector3d& centre = robot.joints[static_cast<std::size_t>(i)].link.centre_of_mass;
    Vector3d mean = Vector3d::Zero();
    for (const auto& p : shape.links[static_cast<std::size_t>(i + 1)].path) mean += p;
    EXPECT_GT(mean.normalized().dot(centre.normalized()), 0.95) << "link " << i + 1;
  }
}

TEST(WorkspaceGrid, LiesBelowTheWorkspaceAndNamesItsAxes) {
  const auto robot = test::leftArm();
  EXPECT_EQ(upAxis(robot.gravity), (std::pair{0, 1.0})) << "gravity is −x of frame 0";
  const auto box = reachOf(robot);
  const WorkspaceGrid grid = gridAround(box, 0, 1.0);
  EXPECT_LT(grid.low.x(), box[0].x());
  EXPECT_GT(grid.high.x(), box[1].x());
  int names = 0;
  for (const auto& label : grid.labels) names += label.name;
  EXPECT_EQ(names, 3);
  const WorkspaceGrid hanging = gridAround(box, 0, -1.0);
  EXPECT_GT(hanging.low.x(), box[1].x()) << "upside down the grid is on the other side";
}

}  // namespace
}  // namespace capstan::widgets
