#include <gtest/gtest.h>

#include <QCoreApplication>
#include <QSemaphore>
#include <QTest>
#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "tests/widgets/picture.h"
#include "tests/widgets/scene_snapshot.h"
#include "widgets/scene/render_thread.h"
#include "widgets/scene/scene_view.h"

namespace capstan::widgets {
namespace {

using Eigen::Vector3d;

const Vector3d kJoints(0.7, 1.5, 0.40);

/// A shown 3-D view of the left arm with a rig before its workspace.
class SceneWindow : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(SceneView::available()) << "this test runs in an X server";
    view.resize(720, 560);
    view.setRobot(robot, test::stereoRig(), test::cameraBefore(arm.tip(kJoints)));
    view.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&view));
  }
  tracking::Snapshot at(double t, const Vector3d& q, double sigma) const {
    return test::snapshotAt(arm, t, q, Vector3d::Constant(sigma));
  }
  /// Where two pictures differ.
  static test::Count difference(const QImage& a, const QImage& b) {
    QImage change(a.size(), QImage::Format_RGB32);
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x)
        change.setPixel(x, y, test::distance(a.pixel(x, y), b.pixel(x, y)) > 12 ? 0xffffffff : 0xff000000);
    return test::count(change, change.rect(), Qt::white, 1);
  }

  robot::Description robot = test::leftArm();
  robot::ArmKinematics arm{robot};
  SceneView view;
};

TEST_F(SceneWindow, EllipsoidGrowsWithTheCovariance) {
  view.setEllipsoidScale(1.0);
  view.camera().look(arm.tip(kJoints), 0.6, 0.3, 0.2);
  view.showSnapshot(at(1.0, kJoints, 0.0));
  const QImage bare = view.image();
  std::array<test::Count, 2> seen;
  for (int i = 0; i < 2; ++i) {
    view.showSnapshot(at(1.0, kJoints, 0.015 * (i + 1)));
    const QImage drawn = view.image();
    test::leave(drawn, QString("scene_ellipsoid_%1").arg(i));
    seen[static_cast<std::size_t>(i)] = difference(bare, drawn);
  }
  ASSERT_GT(seen[0].pixels, 500);
  EXPECT_NEAR(static_cast<double>(seen[1].box.width()) / seen[0].box.width(), 2.0, 0.1);
  const double focal = 0.5 * view.height() / std::tan(0.5 * view.camera().viewAngle());
  EXPECT_NEAR(seen[0].box.width(), 2.0 * 0.03 * focal / 0.6, 6.0)
      << "twice the standard deviation on both sides";
  EXPECT_NEAR(seen[0].centre.x(), 0.5 * view.width(), 4.0) << "centred on the tip, where the camera looks";
  EXPECT_NEAR(seen[0].centre.y(), 0.5 * view.height(), 4.0);
}

TEST_F(SceneWindow, EllipsoidIsLongAlongTheUncertainAxis) {
  view.setRegistration(std::nullopt);  // rays through a translucent body would count as its edge
  view.setEllipsoidScale(1.0);
  view.camera().look(arm.tip(kJoints), 0.6, 0.0, 0.0);
  auto snapshot = at(1.0, kJoints, 0.0);
  view.showSnapshot(snapshot);
  const QImage bare = view.image();
  snapshot.tip_ukf_covariance = Vector3d(0.02 * 0.02, 0.005 * 0.005, 0.005 * 0.005).asDiagonal();
  view.showSnapshot(snapshot);
  const QImage drawn = view.image();
  test::leave(drawn, "scene_ellipsoid_long");
  const test::Count seen = difference(bare, drawn);
  EXPECT_NEAR(static_cast<double>(seen.box.height()) / seen.box.width(), 4.0, 0.5)
      << "x of frame 0 points up";
}

TEST_F(SceneWindow, FrustaStandWhereTheRegistrationPutsThem) {
  view.showSnapshot(at(1.0, kJoints, 0.001));
  const QImage with = view.image();
  const Vector3d apex = test::cameraBefore(arm.tip(kJoints)).translation();
  view.setRegistration(std::nullopt);
  const test::Count seen = difference(with, view.image());
  ASSERT_GT(seen.pixels, 150) << "the frusta are visible";
  const auto pixel = view.camera().project(apex, view.size());
  ASSERT_TRUE(pixel);
  EXPECT_TRUE(seen.box.adjusted(-6, -6, 6, 6).contains(pixel->toPoint()));
}

TEST_F(SceneWindow, LostCameraTurnsAmber) {
  auto snapshot = at(1.0, kJoints, 0.001);
  view.showSnapshot(snapshot);
  const int before = test::count(view.image(), view.rect(), Theme::dark().warning, 40).pixels;
  snapshot.marker[0].fault = snapshot.marker[1].fault = vision::MarkerFault::kNoPixels;
  view.showSnapshot(snapshot);
  const int after = test::count(view.image(), view.rect(), Theme::dark().warning, 40).pixels;
  EXPECT_GT(after, before + 80);
  snapshot.camera_images = false;
  view.showSnapshot(snapshot);
  const int without = test::count(view.image(), view.rect(), Theme::dark().warning, 40).pixels;
  EXPECT_LT(without, before + 40) << "before the first image, nothing is lost";
}

TEST_F(SceneWindow, TrailFollowsTheTipAndEndsAfterItsSeconds) {
  view.setTrailSeconds(3.0);
  const auto moved = [&](double t) {
    return Vector3d(kJoints + Vector3d(0.25 * std::sin(t), 0.2 * std::cos(t), 0.0));
  };
  for (double t = 0.0; t <= 3.0; t += 0.02) view.showSnapshot(at(t, moved(t), 0.0));
  const QImage with = view.image();
  test::leave(with, "scene_trail");
  const auto middle = view.camera().project(arm.tip(moved(2.0)), view.size());
  ASSERT_TRUE(middle);
  const QRect near(middle->toPoint() - QPoint(5, 5), QSize(11, 11));
  const auto green = [&](const QImage& image) {
    return test::count(image, near, Theme::dark().colour(Quantity::kUkf), 70).pixels;
  };
  EXPECT_GT(green(with), 8);
  for (double t = 8.0; t <= 8.1; t += 0.02)
    view.showSnapshot(at(t, kJoints + Vector3d(-0.4, -0.4, 0.0), 0.0));
  EXPECT_EQ(green(view.image()), 0) << "older than three seconds";
}

TEST_F(SceneWindow, CablesTakeTheColourOfTheirForce) {
  auto snapshot = at(1.0, kJoints, 0.0);
  snapshot.cable_tension = Vector3d(50.0, 50.0, 50.0);
  view.showSnapshot(snapshot);
  const auto orange = [&](const QImage& image) {
    int pixels = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x) {
        const QColor c = image.pixelColor(x, y);
        pixels += c.red() > c.blue() + 90;
      }
    return pixels;
  };
  const int pulling = orange(view.image());
  snapshot.cable_tension = -snapshot.cable_tension;
  view.showSnapshot(snapshot);
  EXPECT_GT(pulling, 400);
  EXPECT_LT(orange(view.image()), pulling / 10);
}

TEST_F(SceneWindow, MouseOrbitsPansZoomsAndComesBack) {
  view.showSnapshot(at(1.0, kJoints, 0.001));
  const QImage opening = view.image();
  const Vector3d from = view.camera().position();
  QTest::mousePress(&view, Qt::LeftButton, {}, {300, 300});
  QMouseEvent move(QEvent::MouseMove, QPointF(380, 320), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&view, &move);
  QTest::mouseRelease(&view, Qt::LeftButton, {}, {380, 320});
  EXPECT_GT((view.camera().position() - from).norm(), 0.05);
  QWheelEvent wheel({300, 300}, view.mapToGlobal(QPoint(300, 300)), {}, {0, 240}, Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  const double distance = view.camera().distance();
  QApplication::sendEvent(&view, &wheel);
  EXPECT_LT(view.camera().distance(), distance);
  EXPECT_GT(difference(opening, view.image()).pixels, 2000);
  QTest::mouseDClick(&view, Qt::LeftButton);
  EXPECT_LT(difference(opening, view.image()).pixels, 50);
}

TEST_F(SceneWindow, BothThemesLargeAndSmall) {
  for (double t = 0.0; t <= 4.0; t += 0.02)
    view.showSnapshot(
        at(t, kJoints + Vector3d(0.3 * std::sin(t), 0.25 * std::cos(1.3 * t), 0.03 * std::sin(2 * t)), 4e-4));
  for (const Theme& theme : {Theme::dark(), Theme::light()})
    for (const QSize size : {QSize(1000, 760), QSize(560, 330), QSize(300, 220)}) {
      view.setTheme(theme);
      view.resize(size);
      const QImage scene = view.image();
      EXPECT_LE(test::distance(scene.pixel(3, 3), theme.surface.rgb()), 3);
      test::grab(view, QString("scene_%1_%2").arg(theme.name).arg(size.width()));
    }
}

/// Lets the drawings that the view asked for wait until it is destroyed.
class HeldRenderThread {
 public:
  HeldRenderThread() {
    RenderThread::post([this] { held_.acquire(); });
  }
  ~HeldRenderThread() { release(); }
  void release() {
    if (!std::exchange(released_, true)) held_.release();
  }

 private:
  QSemaphore held_;
  bool released_ = false;
};

TEST_F(SceneWindow, AnotherRobotForgetsTheDrawingOfTheFormerOne) {
  const auto drawn = [this] {
    const QImage seen = view.grab().toImage();
    return seen.width() * seen.height() - test::count(seen, seen.rect(), Theme::dark().surface, 1).pixels;
  };
  view.showSnapshot(at(1.0, kJoints, 0.001));
  view.image();
  ASSERT_GT(drawn(), 500);
  HeldRenderThread held;
  view.showSnapshot(at(1.1, kJoints, 0.001));
  QTest::qWait(200);  // asks for an image
  view.setRobot(robot, std::nullopt, std::nullopt);
  EXPECT_EQ(drawn(), 0) << "nothing is known of the new robot";
  held.release();
  RenderThread::run([] {});
  QCoreApplication::sendPostedEvents(&view, QEvent::MetaCall);
  EXPECT_EQ(drawn(), 0) << "the image that was asked for is of the robot before";
  EXPECT_TRUE(QTest::qWaitFor([&] { return drawn() > 500; }));
}

TEST_F(SceneWindow, ADrawingUnderWayOutlivesNoView) {
  auto other = std::make_unique<SceneView>();
  other->setRobot(robot, test::stereoRig(), test::cameraBefore(arm.tip(kJoints)));
  other->show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(other.get()));
  HeldRenderThread held;
  QTest::qWait(200);  // asks for an image
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    held.release();
  });
  other.reset();
  later.join();
  QTest::qWait(50);  // nothing comes any more
}

}  // namespace
}  // namespace capstan::widgets
