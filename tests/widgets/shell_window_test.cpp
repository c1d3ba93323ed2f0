// The whole window, over real sessions: same numbers as the command line, recording, notes, keys, restored
// settings.
#include <QApplication>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QTextBrowser>
#include <nlohmann/json.hpp>

#include "core/base/resource.h"
#include "core/recording/session_file.h"
#include "core/simulation/camera_mounting.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/panels/registration/registration_panel.h"
#include "widgets/shell/export_controller.h"
#include "widgets/shell/help_window.h"
#include "widgets/shell/simulation_dialog.h"
#include "widgets/shell/source_menu.h"

namespace capstan::widgets {
namespace {

TEST_F(Shell, ShowsTheCommandLinesNumbersToTheLastBit) {
  const QString recording = file("trial.capstan");
  commandLine({"simulate", "--out", recording, "--duration", "3"});
  const auto wanted = nlohmann::json::parse(commandLine({"track", recording, "--json", "-"}).toStdString());

  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(SourceChoice::ofFile(recording));
  ASSERT_TRUE(waitFor([&] { return stateOf(*window) == live::RunState::kEnded; }));
  const auto report = window->link().runner()->report();
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_EQ(report.errors.kinematic().value()(i), wanted["rms"]["kin"][at].get<double>());
    EXPECT_EQ(report.errors.camera().value()(i), wanted["rms"]["cam"][at].get<double>());
    EXPECT_EQ(report.errors.ukf().value()(i), wanted["rms"]["ukf"][at].get<double>());
  }
  EXPECT_EQ(report.nisMean(), wanted["nis"].get<double>());
  EXPECT_EQ(report.errors.ukf().count(), wanted["samples"].get<std::uint64_t>());

  const double degrees = wanted["rms"]["ukf"][0].get<double>() * 180.0 / M_PI;
  ASSERT_TRUE(waitFor([&] {
    return window->errors().cell(0, 2).trimmed() == QString::number(degrees, 'f', 2);
  })) << window->errors().cell(0, 2).toStdString();
}

TEST_F(Shell, TakesUpWhereItWasLeft) {
  {
    auto window = makeWindow();
    window->open(atRest(123.0));
    ASSERT_TRUE(opened(*window));
    window->setThemeNamed("light");
    window->findChild<QDockWidget*>("scene")->hide();
    window->close();
  }
  auto window = makeWindow();
  EXPECT_EQ(window->themeName(), "light");
  EXPECT_TRUE(window->findChild<QDockWidget*>("scene")->isHidden());
  EXPECT_FALSE(window->findChild<QDockWidget*>("errors")->isHidden());
  EXPECT_EQ(window->lastSource().simulation, atRest(123.0).simulation);
  EXPECT_EQ(window->bar().recordingFolder(), file("recordings"));
}

TEST_F(Shell, RecordsWithItsNotes) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  QTest::keyClick(window.get(), Qt::Key_R);
  ASSERT_TRUE(waitFor([&] { return window->link().recording(); })) << window->message().toStdString();
  QTest::keyClick(window.get(), Qt::Key_N);
  ASSERT_TRUE(window->notes().line().hasFocus());
  QTest::keyClicks(&window->notes().line(), "cable 2 re. tightened");
  QTest::keyClick(&window->notes().line(), Qt::Key_Return);
  EXPECT_TRUE(window->link().recording()) << "r in a note is a letter";
  const auto begin = window->link().runner()->status().t;
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().t > begin + 0.3; }));
  QTest::keyClick(window.get(), Qt::Key_R);
  ASSERT_TRUE(waitFor([&] {
    const auto status = window->link().runner()->status();
    return status.recorder && status.recorder->state == recording::RecorderState::kClosed;
  }));
  const QString path = QString::fromStdString(window->link().runner()->status().recording);
  window->close();
  window.reset();

  const auto summary = recording::readSessionSummary(path.toStdString());
  EXPECT_GT(summary.motor, 200);
  EXPECT_GT(summary.frames, 2);
  EXPECT_GT(summary.estimates, 200);
  const auto events = recording::readSessionEvents(path.toStdString());
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), [](const auto& event) {
    return event.kind == "note" && event.text == "cable 2 re. tightened";
  }));

  auto replay = makeWindow();
  replay->open(SourceChoice::ofFile(path));
  ASSERT_TRUE(waitFor([&] { return replay->notes().rows() > 0; }));
  bool listed = false;
  for (int i = 0; i < replay->notes().rows(); ++i)
    listed = listed || replay->notes().row(i).contains("cable 2 re. tightened");
  EXPECT_TRUE(listed) << "a recording brings its notes";
}

TEST_F(Shell, KeysRunPauseAndStep) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  QTest::keyClick(window.get(), Qt::Key_Space);
  ASSERT_TRUE(waitFor([&] { return stateOf(*window) == live::RunState::kPaused; }));
  const double t = window->link().runner()->status().t;
  const auto before = window->link().runner()->report().camera_samples;
  QTest::keyClick(window.get(), Qt::Key_Period);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->report().camera_samples == before + 1; }));
  EXPECT_GT(window->link().runner()->status().t, t);
  EXPECT_EQ(stateOf(*window), live::RunState::kPaused);
  QTest::keyClick(window.get(), Qt::Key_Space);
  ASSERT_TRUE(waitFor([&] { return stateOf(*window) == live::RunState::kRunning; }));
  QTest::keyClick(window.get(), Qt::Key_BracketRight);
  EXPECT_EQ(window->bar().speed(), 2.0);
}

TEST_F(Shell, KeysTypedIntoFieldsStayThere) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  auto* interval = window->findChild<OcclusionPanel*>()->findChild<QDoubleSpinBox*>();
  for (QWidget* field : {static_cast<QWidget*>(&window->notes().line()), static_cast<QWidget*>(interval)}) {
    field->setFocus();
    ASSERT_TRUE(field->hasFocus());
    QTest::keyClick(field, Qt::Key_Period);
    if (field != interval) QTest::keyClick(field, Qt::Key_L);  // no number holds an L
    QTest::keyClick(field, Qt::Key_R);
    if (field != interval) QTest::keyClick(field, Qt::Key_Space);
    QTest::qWait(100);
    const auto status = window->link().runner()->status();
    EXPECT_EQ(status.state, live::RunState::kRunning);
    EXPECT_FALSE(status.blocked[0]);
    EXPECT_FALSE(window->link().recording());
  }
  EXPECT_EQ(window->notes().line().text(), ".lr ");
}

TEST_F(Shell, PlotsStandStillWhenTheUserLooksBack) {
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 3.0; }));
  window->figure().setTimeRange(1.0, 2.0);
  const double end = window->figure().history().end();
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > end + 2.0; }));
  EXPECT_EQ(window->figure().timeRange().lower, 1.0);
  EXPECT_EQ(window->figure().timeRange().upper, 2.0);
}

TEST_F(Shell, BlockedCamerasAreBlockedInFact) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  QTest::keyClick(window.get(), Qt::Key_L);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().blocked[0]; }));
  window->link().runner()->resetErrors();
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->report().frames > 2; }));
  const auto report = window->link().runner()->report();
  EXPECT_EQ(report.gates[static_cast<std::size_t>(tracking::Gate::kLeftLost)], report.frames);
  EXPECT_EQ(report.blocked[0], report.frames);
  EXPECT_EQ(report.detected[1], report.frames);
  EXPECT_TRUE(window->notes().row(window->notes().rows() - 1).contains("left camera blocked"));
}

TEST_F(Shell, ExportsThePlotsAndTheirNumbers) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 0.5; }));
  window->exports().exportPlots(file("plots.pdf"));
  for (const char* ending : {"pdf", "svg", "png", "csv"})
    EXPECT_GT(QFileInfo(file(QString("plots.%1").arg(ending))).size(), 500) << ending;
  window->exports().exportPlots("/proc/nowhere/plots");
  EXPECT_TRUE(window->message().contains("/proc/nowhere/plots")) << window->message().toStdString();
}

TEST_F(Shell, RegistersAnUnregisteredSimulation) {
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  SourceChoice choice = atRest();
  choice.simulation.registered = false;
  window->open(choice);
  ASSERT_TRUE(opened(*window));
  window->action("register")->trigger();
  auto* panel = window->findChild<RegistrationPanel*>();
  ASSERT_TRUE(panel->active());
  ASSERT_TRUE(panel->guide());
  EXPECT_EQ(panel->guide()->fault(), registration::RegistrationFault::kNone) << panel->guide()->reason();
  const auto press = [&](const QString& text) {
    for (auto* button : panel->findChildren<QPushButton*>())
      if (button->text() == text && button->isVisible()) {
        EXPECT_TRUE(waitFor([&] { return button->isEnabled(); })) << text.toStdString();
        return button->click();
      }
    FAIL() << "no button " << text.toStdString();
  };
  test::grab(*panel, "registration_1_stop");
  press("Drive to the hard stop");
  press("Collect frames");
  ASSERT_TRUE(waitFor([&] { return panel->guide()->step() == registration::RegistrationStep::kReview; }))
      << panel->guide()->reason();
  EXPECT_FALSE(test::grab(*panel, "registration_3_result").isNull());
  const auto found = panel->guide()->proposal()->registration.base_from_camera;
  const auto robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  const auto truth = simulation::trueBaseFromCamera(
      robot, simulation::defaultTruth().cameras);  // 0.2 degrees off its drawing
  const Eigen::Vector3d stop = panel->guide()->scatter().mean;
  EXPECT_LT((found * stop - truth * stop).norm(), 1.5e-3);
  press("Accept");
  ASSERT_TRUE(waitFor([&] {
    const auto report = window->link().runner()->report();
    return report.gateShare(tracking::Gate::kOpen) > 0.1;
  })) << "the filter observes the camera as soon as it is registered";
  EXPECT_TRUE(window->notes().row(window->notes().rows() - 1).contains("accepted"));
}

TEST(Help, LeadsToTheTableFormatAndBack) {
  HelpWindow help;
  auto* pages = help.findChild<QTextBrowser*>();
  ASSERT_TRUE(pages);
  const QString manual = help.text();
  EXPECT_TRUE(manual.contains("Keys"));
  pages->setSource(QUrl("measured-table.md"));
  EXPECT_TRUE(help.text().contains("strictly increasing")) << help.text().toStdString();
  pages->backward();
  EXPECT_EQ(help.text(), manual);
}

TEST_F(Shell, TheManualNamesEveryKey) {
  auto window = makeWindow();
  HelpWindow help;
  EXPECT_FALSE(test::grab(help, "help").isNull());
  test::grab(window->bar().sources().dialog(), "simulation_dialog");
  for (const auto* action : window->findChildren<QAction*>()) {
    if (action->shortcut().isEmpty()) continue;
    const QString key = action->shortcut().toString();
    EXPECT_TRUE(help.text().contains(key == "Space" ? "Space" : key)) << key.toStdString();
  }
}

}  // namespace
}  // namespace capstan::widgets
