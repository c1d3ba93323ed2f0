#include <gtest/gtest.h>

#include "tests/widgets/picture.h"
#include "tests/widgets/scene_snapshot.h"
#include "widgets/scene/scene_view.h"

namespace capstan::widgets {
namespace {

using Eigen::Vector3d;

TEST(OrbitCamera, ProjectsLikeAPinhole) {
  OrbitCamera camera;
  camera.setAxes(Vector3d::UnitZ(), Vector3d::UnitX());
  camera.look(Vector3d::Zero(), 2.0, 0.0, 0.0);  // at (2, 0, 0): right is +y, up is +z
  const QSize size(800, 600);
  const double focal = 300.0 / std::tan(0.5 * camera.viewAngle());
  EXPECT_EQ(camera.position(), Vector3d(2, 0, 0));
  EXPECT_EQ(*camera.project(Vector3d::Zero(), size), QPointF(400, 300));
  const QPointF p = *camera.project({0.0, 0.1, 0.2}, size);
  EXPECT_NEAR(p.x(), 400 + focal * 0.1 / 2.0, 1e-9);
  EXPECT_NEAR(p.y(), 300 - focal * 0.2 / 2.0, 1e-9);
  EXPECT_FALSE(camera.project({3.0, 0.0, 0.0}, size)) << "behind";
}

TEST(OrbitCamera, OrbitKeepsDistanceAndStaysShortOfThePoles) {
  OrbitCamera camera;
  camera.look({0.1, 0.2, 0.3}, 1.5, 0.3, 0.2);
  for (int i = 0; i < 100; ++i) camera.orbit(0.1, 0.1);
  EXPECT_NEAR((camera.position() - camera.focus()).norm(), 1.5, 1e-12);
  EXPECT_LT(camera.elevation(), M_PI / 2);
  camera.pan(0.5, 0.0);
  EXPECT_NEAR((camera.position() - camera.focus()).norm(), 1.5, 1e-12);
  camera.zoom(1e-9);
  EXPECT_DOUBLE_EQ(camera.distance(), 0.05);
}

TEST(SceneView, SaysThatItNeedsADisplayAndLeavesVtkAlone) {
  ASSERT_FALSE(SceneView::available());
  SceneView view;
  view.resize(400, 300);
  const auto robot = test::leftArm();
  view.setRobot(robot, test::stereoRig(), std::nullopt);
  view.showSnapshot(
      test::snapshotAt(robot::ArmKinematics(robot), 1.0, {0.7, 1.5, 0.4}, Vector3d::Constant(1e-3)));
  const QImage image = test::grab(view, "scene_no_display");
  EXPECT_TRUE(view.image().isNull());
  EXPECT_GT(test::count(image, image.rect(), Theme::dark().muted, 40).pixels, 100) << "the words";
}

TEST(TensionScale, RoundLimitsAndAColourForEachSign) {
  TensionScale scale;
  EXPECT_EQ(scale.limit(), 5.0);
  scale.include({3.0, -17.0, 0.2});
  EXPECT_EQ(scale.limit(), 20.0);
  scale.include({101.0, 0.0, std::nan("")});
  EXPECT_EQ(scale.limit(), 200.0);
  EXPECT_GT(scale.colour(200).red(), scale.colour(200).blue() + 100);
  EXPECT_GT(scale.colour(-200).blue(), scale.colour(-200).red() + 100);
  EXPECT_LT(std::abs(scale.colour(0).red() - scale.colour(0).blue()), 20);
  EXPECT_EQ(scale.colour(1e9), scale.colour(200)) << "clamped";
  EXPECT_EQ(scale.colour(std::nan("")), scale.colour(0));
}

}  // namespace
}  // namespace capstan::widgets
