// A motor encoder that fails, in a real window: seen where the joint is looked at, declared and taken back by
// hand.
#include <QAction>

#include "core/live/motor_failures.h"
#include "core/simulation/simulation_request.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/figures/joint_plot.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/status/status_line.h"

namespace capstan::widgets {
namespace {

/// A simulated robot whose motor encoders fail as said.
class FailingRobot final : public tracking::Source {
 public:
  explicit FailingRobot(const std::string& failure)
      : robot_(simulation::optionsOf(request())),
        failing_(robot_, live::parseMotorFailure(failure, "--fail-motor")) {}
  const tracking::SourceInfo& info() const override { return failing_.info(); }
  bool next(tracking::Sample& out) override { return failing_.next(out); }
  void block(bool left, bool right) override { failing_.block(left, right); }

 private:
  static simulation::SimulationRequest request() {
    simulation::SimulationRequest request;
    request.trajectory = "sinusoid";
    request.duration = 600.0;
    request.images = false;
    return request;
  }
  simulation::SimulatedSource robot_;
  live::FailingMotors failing_;
};

QString titleOf(MainWindow& window, int joint) { return window.figure().plot(joint).header()->title(); }

bool noted(MainWindow& window, const QString& words) {
  for (int row = 0; row < window.notes().rows(); ++row)
    if (window.notes().row(row).contains(words)) return true;
  return false;
}

TEST_F(Shell, AnEncoderThatFailsIsSeenWhereItsJointIs) {
  const auto window = makeWindow();
  EXPECT_FALSE(window->action("motor2failed")->isEnabled()) << "no session";
  window->link().take(std::make_unique<FailingRobot>("2@2:lost"));
  ASSERT_TRUE(opened(*window));
  ASSERT_TRUE(waitFor([&] { return !window->message().isEmpty(); }));
  EXPECT_TRUE(window->message().contains("encoder of motor 2 (elbow) lost"))
      << window->message().toStdString();
  EXPECT_EQ(titleOf(*window, 1), QString::fromUtf8("elbow q2 [deg] · encoder lost"));
  EXPECT_EQ(titleOf(*window, 0), "shoulder q1 [deg]");
  EXPECT_TRUE(waitFor([&] { return statusOf(*window).contains("motor 2 lost"); }))
      << statusOf(*window).toStdString();
  EXPECT_TRUE(noted(*window, "q2 is estimated from the cameras alone"));
  EXPECT_TRUE(window->action("motor2failed")->isChecked());
  EXPECT_FALSE(window->action("motor1failed")->isChecked());
  for (const char* theme : {"dark", "light"}) {
    window->setThemeNamed(theme);
    QTest::qWait(100);
    test::grab(*window, QStringLiteral("motor_lost_%1").arg(theme));
  }
  window->open(atRest());
  ASSERT_TRUE(waitFor([&] { return titleOf(*window, 1) == "elbow q2 [deg]"; }))
      << "another robot, other motors";
  EXPECT_FALSE(window->action("motor2failed")->isChecked());
}

TEST_F(Shell, AMotorIsDeclaredFailedAndBelievedAgainByHand) {
  const auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("motor1failed")->trigger();
  ASSERT_TRUE(waitFor([&] { return titleOf(*window, 0).endsWith(QString::fromUtf8("· encoder failed")); }));
  EXPECT_TRUE(waitFor([&] { return statusOf(*window).contains("motor 1 failed"); }));
  EXPECT_TRUE(noted(*window, "encoder of motor 1 (shoulder) failed"));
  EXPECT_TRUE(window->message().isEmpty()) << "who reports it needs no message";
  window->action("motor1failed")->trigger();
  ASSERT_TRUE(waitFor([&] { return titleOf(*window, 0) == "shoulder q1 [deg]"; }));
  EXPECT_TRUE(waitFor([&] { return !statusOf(*window).contains("motor"); }));
  EXPECT_TRUE(noted(*window, "in use again"));
}

}  // namespace
}  // namespace capstan::widgets
