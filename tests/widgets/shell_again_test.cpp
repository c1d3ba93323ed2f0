// What a session that begins again, or another source, takes over in a real window: the robot in use, the
// registration and failed motors stay with their arm; occlusion belongs to the session.
#include <QAction>
#include <QPushButton>
#include <QSpinBox>

#include "core/base/resource.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/identification/identification_panel.h"
#include "widgets/panels/identification/parameter_choice.h"
#include "widgets/panels/marker/marker_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/panels/status/status_line.h"

namespace capstan::widgets {
namespace {

bool noted(MainWindow& window, const QString& words) {
  for (int row = 0; row < window.notes().rows(); ++row)
    if (window.notes().row(row).contains(words)) return true;
  return false;
}

QString notesOf(MainWindow& window) {
  QStringList rows;
  for (int row = 0; row < window.notes().rows(); ++row) rows << window.notes().row(row);
  return rows.join('\n');
}

bool ended(MainWindow& window) {
  return QTest::qWaitFor([&] { return window.link().ended(); }, 2 * kPatience);
}

/// RMS of the filter on joint 1 [deg], by the runner's report.
double errorOfJoint1(MainWindow& window) {
  return window.link().runner()->report().errors.ukf().value()(0) * 180.0 / M_PI;
}

double radiusInUse(MainWindow& window) { return window.link().runner()->robot().drives[0].link_radius; }

/// A sinusoid of 30 s whose pulley of joint 1 is not as the robot file says; tips without pictures.
SourceChoice wrongRadius(double duration = 30.0) {
  simulation::SimulationRequest request;
  request.trajectory = "sinusoid";
  request.duration = duration;
  request.images = false;
  return SourceChoice::ofSimulation(request);
}

/// Runs `choice` to its end and accepts the radius that the whole of it shows.
void identifyAndAccept(MainWindow& window, const SourceChoice& choice) {
  window.bar().setSpeed(10.0);
  window.identification().choice().setNames("r_l1");
  window.open(choice);
  ASSERT_TRUE(waitFor([&] { return window.link().running(); }));
  QTest::keyClick(&window, Qt::Key_I);
  ASSERT_TRUE(ended(window));
  const auto whole = [&] {
    const auto& live = window.identification().live();
    return live.acceptable() && live.shown().recorded > choice.simulation.duration - 1.0;
  };
  ASSERT_TRUE(QTest::qWaitFor(whole, 2 * kPatience)) << window.identification().words().toStdString();
  window.identification().findChild<QPushButton*>("accept")->click();
  ASSERT_NEAR(radiusInUse(window), 0.059, 0.01 * 0.059);
}

void again(MainWindow& window) {
  QTest::keyClick(&window, Qt::Key_Space);
  ASSERT_TRUE(waitFor([&] { return window.link().running(); }));
}

TEST_F(Shell, TheAcceptedRobotStaysInUseWhenTheSessionBeginsAgain) {
  const auto window = makeWindow();
  identifyAndAccept(*window, wrongRadius());
  const double nominal = window->link().runner()->info().robot.drives[0].link_radius;
  again(*window);
  EXPECT_NEAR(radiusInUse(*window), 0.059, 0.01 * 0.059) << "the accepted robot was dropped";
  EXPECT_TRUE(statusOf(*window).contains("robot RAVEN-II left, identified"))
      << statusOf(*window).toStdString();
  EXPECT_TRUE(noted(*window, "stays in use")) << notesOf(*window).toStdString();
  ASSERT_TRUE(ended(*window));
  EXPECT_LT(errorOfJoint1(*window), 0.2) << "with the identified radius some hundredths, else degrees";

  auto* undo = window->identification().findChild<QPushButton*>("revert");
  ASSERT_TRUE(undo->isVisible()) << "only a person takes it back, and can";
  undo->click();
  EXPECT_EQ(radiusInUse(*window), nominal);
  EXPECT_FALSE(statusOf(*window).contains("identified")) << statusOf(*window).toStdString();
  again(*window);
  EXPECT_EQ(radiusInUse(*window), nominal) << "taken back for good";
  EXPECT_TRUE(statusOf(*window).contains("robot RAVEN-II left")) << statusOf(*window).toStdString();
}

TEST_F(Shell, TheAcceptedRobotBelongsToItsArm) {
  const auto window = makeWindow();
  identifyAndAccept(*window, wrongRadius());
  const QString recording = file("trial.capstan");
  commandLine({"simulate", "--no-images", "--duration", "2", "--out", recording});
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(waitFor([&] { return !window->link().runner()->info().live; }));
  EXPECT_NEAR(radiusInUse(*window), 0.059, 0.01 * 0.059) << "a replay of the same arm";
  EXPECT_TRUE(noted(*window, "stays in use")) << notesOf(*window).toStdString();

  SourceChoice other = wrongRadius(40.0);
  other.simulation.robot = base::resource("robots/raven2_right.yaml").string();
  window->open(other);
  ASSERT_TRUE(waitFor([&] { return window->lastSource().simulation == other.simulation; }));
  EXPECT_EQ(radiusInUse(*window), window->link().runner()->info().robot.drives[0].link_radius);
  EXPECT_TRUE(noted(*window, "belongs to another robot or truth file")) << notesOf(*window).toStdString();
  EXPECT_FALSE(statusOf(*window).contains("identified")) << statusOf(*window).toStdString();

  window->open(wrongRadius(50.0));
  ASSERT_TRUE(waitFor([&] { return window->lastSource().simulation.duration == 50.0; }));
  EXPECT_NEAR(radiusInUse(*window), 0.059, 0.01 * 0.059) << "back at the arm that it belongs to";
}

TEST_F(Shell, RegistrationAndFailedMotorsStayWhenTheSessionBeginsAgain) {
  const auto window = makeWindow();
  window->bar().setSpeed(10.0);
  SourceChoice choice = atRest(20.0);
  choice.simulation.registered = false;
  window->open(choice);
  ASSERT_TRUE(opened(*window));
  Q_EMIT window->findChild<RegistrationPanel*>()->accepted(Eigen::Isometry3d::Identity(), {});
  window->action("motor1failed")->trigger();
  ASSERT_TRUE(waitFor([&] { return window->action("motor1failed")->isChecked(); }));
  ASSERT_TRUE(ended(*window));
  again(*window);
  EXPECT_TRUE(waitFor([&] { return window->action("motor1failed")->isChecked(); }))
      << "a motor that was declared failed is in use again";
  bool registered = false, asked = false;
  window->link().runner()->post([&](tracking::Source&, tracking::TrackingPipeline& pipeline) {
    registered = pipeline.registration().has_value();
    asked = true;
  });
  ASSERT_TRUE(waitFor([&] { return asked; }));
  EXPECT_TRUE(registered) << "the accepted registration was dropped";
}

TEST_F(Shell, TheLimitsOfTheMarkerStayWhenTheSessionBeginsAgain) {
  const auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(atRest(5.0));
  ASSERT_TRUE(opened(*window));
  auto* panel = window->findChild<MarkerPanel*>();
  panel->findChild<QSpinBox*>("hue_low")->setValue(50);
  ASSERT_TRUE(ended(*window));
  again(*window);
  EXPECT_EQ(window->link().runner()->marker().hue_low, 50) << "the chosen limits were dropped";
  EXPECT_EQ(panel->options().hue_low, 50);

  window->open(atRest(6.0));
  ASSERT_TRUE(waitFor([&] { return window->lastSource().simulation.duration == 6.0; }));
  EXPECT_EQ(window->link().runner()->marker().hue_low, vision::MarkerOptions{}.hue_low) << "another source";
}

/// Records a second of the open session, and gives the file.
QString recorded(MainWindow& window) {
  const auto stateIs = [&](recording::RecorderState state) {
    const auto status = window.link().runner()->status();
    return status.recorder && status.recorder->state == state;
  };
  window.action("record")->trigger();
  EXPECT_TRUE(waitFor([&] { return stateIs(recording::RecorderState::kRecording); }));
  const double begin = window.link().runner()->status().t;
  EXPECT_TRUE(waitFor([&] { return window.link().runner()->status().t > begin + 1.0; }));
  window.action("record")->trigger();
  EXPECT_TRUE(waitFor([&] { return stateIs(recording::RecorderState::kClosed); }));
  return QString::fromStdString(window.link().runner()->status().recording);
}

TEST_F(Shell, ARecordingMadeWithTheChosenRobotIsOfTheSameArm) {
  const auto window = makeWindow();
  window->open(wrongRadius(600.0));
  ASSERT_TRUE(opened(*window));
  robot::Description robot = window->link().runner()->info().robot;
  robot.drives[0].link_radius *= 1.01;
  ASSERT_TRUE(window->link().useRobot(robot, {"identified", "a test", "r_l1 +1 %"}));
  const QString made = recorded(*window);
  window->open(SourceChoice::ofFile(made));
  ASSERT_TRUE(waitFor([&] { return !window->link().runner()->info().live; }));
  EXPECT_EQ(radiusInUse(*window), robot.drives[0].link_radius);
  EXPECT_FALSE(noted(*window, "chosen before")) << notesOf(*window).toStdString();
  EXPECT_TRUE(noted(*window, "RAVEN-II left, identified, the source's own"))
      << notesOf(*window).toStdString();
  EXPECT_TRUE(statusOf(*window).contains("robot RAVEN-II left, identified"))
      << statusOf(*window).toStdString();
}

void press(MainWindow& window, const QString& share) {
  for (auto* button : window.findChild<OcclusionPanel*>()->findChildren<QPushButton*>())
    if (button->text() == share) button->click();
}

TEST_F(Shell, AScheduleEndsWithItsSource) {
  const QString recording = file("trial.capstan");
  commandLine({"simulate", "--trajectory", "hold", "--duration", "10", "--out", recording});
  const auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  press(*window, "80");
  QTest::keyClick(window.get(), Qt::Key_L);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().occlusion.percentage == 80.0; }));
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().blocked[0]; }));
  EXPECT_TRUE(waitFor([&] { return statusOf(*window).contains("occlusion 80 %"); }))
      << statusOf(*window).toStdString();

  window->bar().setSpeed(10.0);
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(ended(*window));
  const auto report = window->link().runner()->report();
  EXPECT_GT(report.frames, 100U);
  EXPECT_EQ(report.detected[0], report.frames) << "a replayed recording was occluded";
  EXPECT_EQ(report.detected[1], report.frames);
  EXPECT_EQ(window->findChild<OcclusionPanel*>()->schedule().percentage, 0.0);
  EXPECT_FALSE(statusOf(*window).contains("occlusion")) << statusOf(*window).toStdString();
  EXPECT_EQ(window->figure().history().occluded().size(), 0U);
}

TEST_F(Shell, OcclusionAddedToARecordingIsSaidEverywhere) {
  const QString recording = file("trial.capstan");
  commandLine({"simulate", "--trajectory", "hold", "--duration", "10", "--out", recording});
  const auto window = makeWindow();
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(opened(*window));
  window->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window->link().recording(); }));
  press(*window, "80");
  ASSERT_TRUE(waitFor([&] { return statusOf(*window).contains("occlusion 80 %, added to the recording"); }))
      << statusOf(*window).toStdString();
  EXPECT_TRUE(noted(*window, "added to the recording")) << notesOf(*window).toStdString();
  ASSERT_TRUE(waitFor([&] { return window->figure().history().occluded().size() > 0; })) << "shaded";
  window->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] {
    const auto status = window->link().runner()->status();
    return status.recorder && status.recorder->state == recording::RecorderState::kClosed;
  }));
  const auto made = window->link().runner()->status().recording;
  bool schedule = false, blocked = false;
  for (const auto& event : recording::readSessionEvents(made)) {
    schedule = schedule || event.text.find("80 % of the time, in intervals of 2.0 s, added to a recording") !=
                               std::string::npos;
    blocked = blocked || event.text == "both blocked, added to a recording";
  }
  EXPECT_TRUE(schedule) << "the file of the replay knows";
  EXPECT_TRUE(blocked);

  ASSERT_TRUE(ended(*window));
  again(*window);  // the same session once more: it stays, and is said again
  EXPECT_EQ(window->findChild<OcclusionPanel*>()->schedule().percentage, 80.0);
  EXPECT_TRUE(noted(*window, "added to the recording")) << notesOf(*window).toStdString();
}

}  // namespace
}  // namespace capstan::widgets
