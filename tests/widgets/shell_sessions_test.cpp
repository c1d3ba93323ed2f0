// Opening one source after another in a real window: names, blocked cameras, failures, and calm while one is
// stuck.
#include <QPushButton>
#include <latch>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/resource.h"
#include "core/recording/session_file.h"
#include "tests/support/folders.h"
#include "tests/widgets/picture.h"
#include "tests/widgets/shell_fixture.h"
#include "widgets/panels/notes/notes_panel.h"
#include "widgets/panels/occlusion/occlusion_panel.h"
#include "widgets/shell/recent_menu.h"
#include "widgets/shell/source_menu.h"
#include "widgets/shell/units_dialog.h"

namespace capstan::widgets {
namespace {

TEST_F(Shell, SaysWhatIsWrongWithAFileAndKeepsTheSession) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->open(SourceChoice::ofFile(file("gone.capstan")));
  ASSERT_TRUE(waitFor([&] { return !window->message().isEmpty(); }));
  EXPECT_TRUE(window->message().contains("gone.capstan")) << window->message().toStdString();
  EXPECT_EQ(stateOf(*window), live::RunState::kRunning);
  EXPECT_TRUE(window->lastSource().simulated) << "a file that could not be opened is no last source";
  EXPECT_TRUE(window->bar().sources().recent().files().isEmpty());
}

/// The same recording gives the same errors, bit by bit, whichever face tracks it.
TEST_F(Shell, ErrorsAreThoseOfTheCommandLine) {
  commandLine(
      {"simulate", "--no-images", "--duration", "6", "--trajectory", "sinusoid", "--out", file("s.capstan")});
  const auto said =
      nlohmann::json::parse(commandLine({"track", file("s.capstan"), "--json", "-"}).toStdString());
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(SourceChoice::ofFile(file("s.capstan")));
  ASSERT_TRUE(waitFor([&] { return window->link().ended(); }));
  const tracking::TrackReport report = window->link().runner()->report();
  EXPECT_EQ(report.motor_samples, said["samples"].get<std::uint64_t>());
  for (int joint = 0; joint < 3; ++joint) {
    EXPECT_EQ(report.errors.kinematic().value()(joint), said["rms"]["kin"][joint].get<double>());
    EXPECT_EQ(report.errors.camera().value()(joint), said["rms"]["cam"][joint].get<double>());
    EXPECT_EQ(report.errors.ukf().value()(joint), said["rms"]["ukf"][joint].get<double>());
  }
}

TEST_F(Shell, SaysThatADriveOfOneJointIsForTheCommandLine) {
  QFile table(file("jaw.csv"));
  ASSERT_TRUE(table.open(QIODevice::WriteOnly));
  table.write("t,q_m1,q1\n0.000,1.0,0.3\n0.004,1.0,0.3\n");
  table.close();
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  SourceChoice jaw = SourceChoice::ofFile(table.fileName());
  jaw.robot =
      QString::fromStdString(capstan::test::sourceFile("tests/core/identification/data/davinci_jaw.yaml"));
  window->open(jaw);
  ASSERT_TRUE(waitFor([&] { return !window->message().isEmpty(); }));
  EXPECT_TRUE(window->message().contains("da Vinci jaw has 1")) << window->message().toStdString();
  EXPECT_TRUE(window->message().contains("tracking is made for three"));
  EXPECT_TRUE(window->message().contains("capstan-cli identify"));
  EXPECT_EQ(stateOf(*window), live::RunState::kRunning) << "the session before goes on";
}

TEST_F(Shell, ATableInMillimetresAsksBeforeItIsTracked) {
  QFile table(file("mm.csv"));
  ASSERT_TRUE(table.open(QIODevice::WriteOnly));
  table.write("t,q_m1,q_m2,q_m3,q1,q2,q3\n");
  for (int row = 0; row < 2000; ++row)
    table.write(QStringLiteral("%1,80,-80,-480,0.6,1.6,340\n").arg(row * 1e-3).toUtf8());
  table.close();
  const auto window = makeWindow();
  window->open(SourceChoice::ofFile(table.fileName()));
  UnitsDialog* dialog = nullptr;
  ASSERT_TRUE(waitFor([&] { return (dialog = window->findChild<UnitsDialog*>("units")) != nullptr; }));
  EXPECT_EQ(window->link().runner(), nullptr) << "nothing is tracked yet";
  EXPECT_EQ(dialog->readAs(), "q3=mm");
  auto* unit = dialog->findChild<QComboBox*>("q3");
  ASSERT_TRUE(unit);
  EXPECT_GE(unit->findText("millimetres", Qt::MatchContains), 0);
}

TEST_F(Shell, OfTwoChoicesTheNewerIsOpenedUnderItsOwnName) {
  auto window = makeWindow();
  window->open(atRest(111.0));
  window->open(SourceChoice::ofFile(file("gone.capstan")));
  window->open(atRest(222.0));
  EXPECT_TRUE(window->link().opening());
  ASSERT_TRUE(opened(*window));
  EXPECT_EQ(window->link().runner()->info().duration, 222.0);
  EXPECT_EQ(window->lastSource().simulation.duration, 222.0);
  EXPECT_TRUE(window->message().isEmpty()) << "what was taken back is not complained of";
  EXPECT_FALSE(window->link().opening());
}

TEST_F(Shell, TwoChoicesDuringARecordingEndItWhole) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->action("record")->trigger();
  ASSERT_TRUE(waitFor([&] { return window->link().recording(); }));
  const std::string recorded = window->link().runner()->status().recording;
  window->open(atRest(111.0));
  window->open(atRest(222.0));
  ASSERT_TRUE(waitFor(
      [&] { return window->link().runner()->info().duration == 222.0 && !window->link().opening(); }));
  QTest::qWait(500);
  EXPECT_TRUE(window->message().isEmpty()) << window->message().toStdString();
  EXPECT_NO_THROW(recording::readSessionSummary(recorded));
}

TEST_F(Shell, ShowsACommandThatFailed) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  window->link().runner()->post([](tracking::Source&, tracking::TrackingPipeline&) {
    throw std::runtime_error("the brake does not answer");
  });
  ASSERT_TRUE(waitFor([&] { return window->message().contains("the brake does not answer"); }));
  EXPECT_EQ(stateOf(*window), live::RunState::kRunning);
}

TEST_F(Shell, AScheduleBeginsAnewWhenItsSessionDoes) {
  auto window = makeWindow();
  window->bar().setSpeed(10.0);
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 1.0; }));
  auto* panel = window->findChild<OcclusionPanel*>();
  for (auto* button : panel->findChildren<QPushButton*>())
    if (button->text() == "40") button->click();
  ASSERT_GT(panel->schedule().start, 0.9);
  window->open(atRest());
  ASSERT_TRUE(waitFor([&] { return window->link().again(); }));
  EXPECT_EQ(panel->schedule().start, 0.0);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().occlusion.percentage == 40.0; }));
  EXPECT_EQ(window->link().runner()->status().occlusion.start, 0.0);
}

/// Stuck inside next() until the test lets it go.
class StuckSource final : public tracking::Source {
 public:
  explicit StuckSource(std::latch& gate) : gate_(gate) {
    info_.title = "stuck";
    info_.robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample&) override {
    gate_.wait();
    return false;
  }
  void block(bool, bool) override {}

 private:
  tracking::SourceInfo info_;
  std::latch& gate_;
};

/// Motors at rest for two seconds; with tips where `tips` is set; never pictures.
class WithoutPictures final : public tracking::Source {
 public:
  explicit WithoutPictures(bool tips) : tips_(tips) {
    info_.title = "without pictures";
    info_.robot = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    const double t = 1e-3 * ++count_;
    if (tips_ && count_ % 66 == 0)
      out = tracking::TipSample{t, t, Eigen::Vector3d::Zero()};
    else
      out =
          tracking::MotorSample{t, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    return true;
  }
  void block(bool, bool) override {}

 private:
  tracking::SourceInfo info_;
  bool tips_;
  int count_ = 0;
};

TEST_F(Shell, BlocksTipsWithoutPicturesAndNothingWhereThereIsNoCamera) {
  auto window = makeWindow();
  window->open(atRest());
  ASSERT_TRUE(opened(*window));
  QTest::keyClick(window.get(), Qt::Key_B);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().blocked[0]; }));
  auto* panel = window->findChild<OcclusionPanel*>();

  window->link().take(std::make_unique<WithoutPictures>(false));
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().t > 0.3; }));
  EXPECT_FALSE(panel->isEnabled());
  EXPECT_FALSE(window->link().runner()->status().blocked[0]) << "nobody could free it again";

  window->link().take(std::make_unique<WithoutPictures>(true));
  ASSERT_TRUE(waitFor([&] { return panel->isEnabled(); }));
  EXPECT_FALSE(window->link().runner()->status().blocked[0]) << "blocked in the session before the last";
  QTest::keyClick(window.get(), Qt::Key_B);
  ASSERT_TRUE(waitFor([&] { return window->link().runner()->status().blocked[0]; }));
  QTest::keyClick(window.get(), Qt::Key_B);
  ASSERT_TRUE(waitFor([&] { return !window->link().runner()->status().blocked[0]; }));
}

TEST_F(Shell, StaysResponsiveWhileThePipelineIsStuck) {
  std::latch gate(1);
  auto window = makeWindow();
  window->link().take(std::make_unique<StuckSource>(gate));
  ASSERT_EQ(window->link().runner()->info().title, "stuck");
  for (const int key : {Qt::Key_Space, Qt::Key_Period, Qt::Key_B, Qt::Key_E, Qt::Key_R, Qt::Key_BracketLeft})
    QTest::keyClick(window.get(), static_cast<Qt::Key>(key));
  window->action("theme")->trigger();
  window->resize(1000, 700);
  EXPECT_FALSE(window->grab().isNull());
  EXPECT_EQ(window->themeName(), "light");
  window->open(atRest());  // away from the stuck one, without waiting for it
  EXPECT_TRUE(waitFor([&] {
    return window->link().runner() && window->link().runner()->info().title != "stuck" &&
           stateOf(*window) == live::RunState::kRunning;
  }));
  gate.count_down();
}

// Degrees in q_m: nothing is tracked before a person has chosen.
TEST_F(Shell, ATableInDegreesAsksBeforeItIsTracked) {
  QByteArray text = "t,q_m1,q_m2,q_m3\n";
  for (int row = 0; row < 4000; ++row) text += QByteArray::number(1e-3 * row) + ",4600,-4600,-27500\n";
  QFile table(file("degrees.csv"));
  ASSERT_TRUE(table.open(QIODevice::WriteOnly));
  table.write(text);
  table.close();
  auto window = makeWindow();
  window->open(SourceChoice::ofFile(table.fileName()));
  UnitsDialog* dialog = nullptr;
  ASSERT_TRUE(waitFor([&] { return (dialog = window->findChild<UnitsDialog*>("units")) != nullptr; }));
  EXPECT_FALSE(dialog->isModal());
  EXPECT_EQ(window->link().runner(), nullptr) << "nothing is tracked yet";
  EXPECT_EQ(dialog->readAs(), "q_m1=deg,q_m2=deg,q_m3=deg");
  test::grab(*dialog, "shell_units");
  QTest::keyClick(dialog, Qt::Key_Return);
  ASSERT_TRUE(waitFor([&] { return window->link().runner() != nullptr; }));
  EXPECT_EQ(window->lastSource().read_as, "q_m1=deg,q_m2=deg,q_m3=deg");
  ASSERT_TRUE(waitFor([&] { return window->figure().history().end() > 0.5; }));
}

// What was said of other columns before is kept.
TEST_F(Shell, TheDialogOfUnitsKeepsWhatWasSaidBefore) {
  QFile table(file("both.csv"));
  ASSERT_TRUE(table.open(QIODevice::WriteOnly));
  table.write("t,q_m1,q_m2,q_m3,q1,q2,q3\n");
  for (int row = 0; row < 2000; ++row)
    table.write(QStringLiteral("%1,4600,-4600,-27500,0.6,1.6,340\n").arg(row * 1e-3).toUtf8());
  table.close();
  auto window = makeWindow();
  SourceChoice choice = SourceChoice::ofFile(table.fileName());
  choice.read_as = "q_m=deg";
  window->open(choice);
  UnitsDialog* dialog = nullptr;
  ASSERT_TRUE(waitFor([&] { return (dialog = window->findChild<UnitsDialog*>("units")) != nullptr; }));
  EXPECT_EQ(dialog->readAs(), "q3=mm");
  QTest::keyClick(dialog, Qt::Key_Return);
  ASSERT_TRUE(waitFor([&] { return window->link().runner() != nullptr; })) << window->message().toStdString();
  EXPECT_EQ(window->lastSource().read_as, "q3=mm,q_m=deg");
}

}  // namespace
}  // namespace capstan::widgets
