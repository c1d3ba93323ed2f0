// The diagnosis panel without a window around it: reports handed in or made by a job of the test's own.
#include <gmock/gmock.h>

#include <QComboBox>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QToolButton>
#include <QTreeWidget>
#include <QtTest/QTest>
#include <atomic>

#include "core/base/error.h"
#include "tests/widgets/diagnosis_fixture.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/diagnosis/ranking_table.h"
#include "widgets/panels/diagnosis/recording_picker.h"
#include "widgets/panels/diagnosis/signature_view.h"
#include "widgets/panels/diagnosis/time_view.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;

TEST_F(Diagnosis, BeginsWithAQuestionAndNothingToPress) {
  EXPECT_THAT(headline(), HasSubstr("Where is the robot model wrong?"));
  EXPECT_FALSE(button("diagnose_now")->isEnabled()) << "no recording";
  EXPECT_FALSE(button("save_extended")->isVisible());
  panel->choose({.recordings = {"/somewhere/one.csv"}});
  EXPECT_TRUE(button("diagnose_now")->isEnabled());
  EXPECT_THAT(headline(), HasSubstr("Ready"));
  test::grab(*panel, "diagnosis_panel_empty");
}

TEST_F(Diagnosis, AFoundCauseHasANamePlaceSizeAndWorth) {
  panel->showReport(sample(Verdict::kFound));
  EXPECT_THAT(headline(), HasSubstr("Found"));
  EXPECT_THAT(headline(), HasSubstr("joint 2"));
  EXPECT_THAT(causes(), HasSubstr("half width 0.930 ± 0.030 mm"));
  EXPECT_THAT(causes(), HasSubstr("97 %"));
  EXPECT_THAT(causes(), HasSubstr("q2 on held-out data: 0.894"));
  EXPECT_THAT(causes(), HasSubstr("moves joint 2 by 0.859 deg RMS (largest 1.89 deg), "
                                  "the tip by 3.10 mm RMS (largest 6.82 mm)"));
  EXPECT_TRUE(panel->summary().startsWith("Tip displacement: 3.10 mm RMS (largest 6.82 mm)."))
      << panel->summary().toStdString();
  EXPECT_TRUE(card().contains("What would show it best:")) << card().toStdString();
  for (int page = 0; page < panel->pages().count(); ++page) {
    panel->pages().setCurrentIndex(page);
    QTest::qWait(50);
    test::grab(*panel, QStringLiteral("diagnosis_panel_found_%1").arg(page));
  }
}

// What is shown is what the report has: of the channel that gains most by the cause, the strongest first.
TEST_F(Diagnosis, TheSignatureOfTheCauseStandsInFront) {
  const Report& report = sample(Verdict::kFound);
  panel->showReport(report);
  const auto channel = std::find_if(report.channels.begin(), report.channels.end(),
                                    [](const auto& one) { return one.refitted.name == "q2"; });
  ASSERT_NE(channel, report.channels.end());
  SignatureView& view = panel->pages().signatures();
  EXPECT_THAT(view.channels().currentText().toStdString(), HasSubstr("q2"));
  ASSERT_EQ(view.variables().topLevelItemCount(), static_cast<int>(channel->before.size()));
  EXPECT_EQ(view.variables().topLevelItem(0)->toolTip(0).toStdString(), channel->before[0].variable);
  ASSERT_TRUE(view.figure());
  EXPECT_EQ(view.figure()->data().panels.at(0).before.share, channel->before[0].share);
  ASSERT_TRUE(view.figure()->data().panels.at(0).after);
  EXPECT_LT(view.figure()->data().panels.at(0).after->share, 0.5 * channel->before[0].share);
  EXPECT_TRUE(view.words().contains(QString::fromStdString(channel->before[0].variable)))
      << view.words().toStdString();
  EXPECT_GT(view.figure()->height(), 300) << "large enough to be read across a room";
  EXPECT_GT(view.figure()->width(), 500);

  view.variables().setCurrentItem(view.variables().topLevelItem(1));
  EXPECT_EQ(view.figure()->data().panels.at(0).before.variable, channel->before[1].variable);
  view.channels().setCurrentIndex(0);
  EXPECT_EQ(view.figure()->data().panels.at(0).before.variable, report.channels[0].before[0].variable);
}

TEST_F(Diagnosis, TheCourseShowsThreeModelsOfTheSameChannel) {
  panel->showReport(sample(Verdict::kFound));
  EXPECT_FALSE(panel->pages().course().figure()) << "nobody looks";
  panel->pages().setCurrentIndex(1);
  ASSERT_TRUE(panel->pages().course().figure());
  const auto& trace = panel->pages().course().figure()->data().traces.at(0);
  EXPECT_EQ(trace.channel, "q2");
  EXPECT_EQ(trace.extended.size(), trace.t.size());
  EXPECT_GT(trace.refitted_statistics.rms, 2.0 * trace.extended_statistics.rms);
  EXPECT_THAT(panel->pages().course().words().toStdString(), HasSubstr("with the causes found"));
}

TEST_F(Diagnosis, CandidatesStandByRoundAndScoreAndShowTheirWords) {
  panel->showReport(sample(Verdict::kSeveral));
  EXPECT_THAT(headline(), HasSubstr("Several"));
  const QStringList lines = panel->pages().ranking().lines();
  ASSERT_EQ(lines.size(), 6);
  EXPECT_THAT(lines[0].toStdString(), HasSubstr("91 % | 412 | 97 %"));
  EXPECT_THAT(lines[3].toStdString(), HasSubstr("1.0 % | — | –")) << "only screened";
  EXPECT_TRUE(lines[0].startsWith("● ")) << lines[0].toStdString();
  EXPECT_FALSE(lines[1].startsWith("● ")) << lines[1].toStdString();
  EXPECT_THAT(lines[4].toStdString(), HasSubstr("190"));
  panel->pages().setCurrentIndex(2);
  auto* round = panel->pages().ranking().topLevelItem(1);  // below the explanation of the columns
  panel->pages().ranking().setCurrentItem(round->child(2));
  EXPECT_EQ(panel->pages().ranking().chosen()->effect, "asymmetric_friction");
  EXPECT_TRUE(card().contains("candidate")) << card().toStdString();
  test::grab(*panel, "diagnosis_panel_several");
}

TEST_F(Diagnosis, ATieSaysWhatWouldPartIt) {
  panel->showReport(sample(Verdict::kTie));
  EXPECT_THAT(headline(), HasSubstr("Cannot be distinguished"));
  EXPECT_THAT(causes(), HasSubstr("One of these (probabilities relative to each other):"));
  EXPECT_THAT(panel->summary().toStdString(), ::testing::ContainsRegex("To distinguish backlash, .* and .*"
                                                                       "hysteresis .*: Reverse joint 2"));
  EXPECT_EQ(QString::fromStdString(causes()).count("half width"), 1) << "the tied cause is listed once";
  test::grab(*panel, "diagnosis_panel_tie");
}

TEST_F(Diagnosis, ATieKeepsItsPlaceAmongTheCauses) {
  Report report = sample(Verdict::kSeveral);
  const diagnosis::Tie tie = sample(Verdict::kTie).ties.front();
  ASSERT_EQ(report.causes.front().effect, tie.causes.front().effect);
  report.ties = {tie};
  report.verdict = Verdict::kTie;  // its first cause is tied
  panel->showReport(report);
  const auto placesOf = [](const std::string& list) {
    return std::pair(list.find("One of these"), list.find("Eccentric motor capstan"));
  };
  const auto [tie_first, alone_second] = placesOf(causes());
  ASSERT_NE(alone_second, std::string::npos) << causes();
  EXPECT_LT(tie_first, alone_second) << causes();
  EXPECT_THAT(headline(),
              ::testing::ContainsRegex("Cannot be distinguished: backlash, .* — or .*hysteresis.*; "
                                       "there as well: eccentric"));
  std::ranges::reverse(report.causes);
  report.verdict = Verdict::kSeveral;
  panel->showReport(report);
  const auto [tie_second, alone_first] = placesOf(causes());
  ASSERT_NE(tie_second, std::string::npos) << causes();
  EXPECT_GT(tie_second, alone_first) << causes();
  EXPECT_EQ(panel->causes().chosen()->effect, "capstan_eccentricity");
  EXPECT_THAT(headline(), ::testing::ContainsRegex("Several causes: .*; backlash, .* — or .*hysteresis"));
}

TEST_F(Diagnosis, NothingAndUnexplainedHaveNoCauseButPictures) {
  panel->showReport(sample(Verdict::kNothing));
  EXPECT_THAT(headline(), HasSubstr("Nothing material"));
  ASSERT_TRUE(panel->pages().signatures().figure());
  EXPECT_FALSE(panel->pages().signatures().figure()->data().panels.at(0).after) << "no cause, no after";
  test::grab(*panel, "diagnosis_panel_nothing");
  panel->showReport(sample(Verdict::kUnexplained));
  EXPECT_THAT(headline(), HasSubstr("no hypothesis explains"));
  EXPECT_TRUE(card().contains("7.3 Hz")) << card().toStdString();
  EXPECT_TRUE(card().contains("q1: depends on")) << card().toStdString();
  EXPECT_FALSE(panel->causes().chosen());
  EXPECT_THAT(panel->pages().signatures().channels().currentText().toStdString(), HasSubstr("q1"))
      << "where something is to be seen";
  EXPECT_THAT(panel->pages().signatures().words().toStdString(), HasSubstr("position of joint 1"));
  test::grab(*panel, "diagnosis_panel_unexplained");
}

TEST_F(Diagnosis, RunsInTheBackgroundWithWhatWasChosen) {
  const auto release = std::make_shared<std::atomic<bool>>(false);
  DiagnosisChoice asked;
  show([&asked, release](const DiagnosisChoice& choice, base::Progress& progress) {
    asked = choice;
    progress.report(0.4, "screening");
    while (!*release && !progress.cancelled()) QThread::msleep(5);
    return sample(Verdict::kFound);
  });
  const DiagnosisChoice choice{.recordings = {"/a/one.csv", "/a/two.csv"}, .robot = "/a/mine.yaml"};
  panel->choose(choice);
  QTest::keyClick(panel.get(), Qt::Key_F5);
  EXPECT_TRUE(panel->busy());
  EXPECT_EQ(button("diagnose_now")->text(), "Cancel");
  EXPECT_THAT(headline(), HasSubstr("Searching for"));
  *release = true;
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_EQ(asked, choice);
  ASSERT_TRUE(panel->report());
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("Of one.csv, two.csv."));
  EXPECT_EQ(button("diagnose_now")->text(), "Diagnose");
}

TEST_F(Diagnosis, IsCancelledAndKeepsWhatWasThere) {
  show([](const DiagnosisChoice&, base::Progress& progress) {
    while (!progress.cancelled()) QThread::msleep(5);
    return Report{};
  });
  panel->choose({.recordings = {"/a/one.csv"}});
  panel->showReport(sample(Verdict::kFound));
  panel->diagnose();
  ASSERT_TRUE(panel->busy());
  EXPECT_THAT(headline(), HasSubstr("Searching for"));
  EXPECT_FALSE(button("save_extended")->isVisible()) << "what is saved would be of the run before";
  QTest::keyClick(panel.get(), Qt::Key_Escape);
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("Cancelled"));
  EXPECT_THAT(headline(), HasSubstr("Found")) << "the report before";
}

TEST_F(Diagnosis, AVerdictStandsUnderItsOwnRecordingsOnly) {
  panel->choose({.recordings = {"/a/one.csv"}});
  panel->showReport(sample(Verdict::kFound));
  EXPECT_THAT(headline(), HasSubstr("Found"));
  panel->choose({.recordings = {"/a/two.csv"}});
  EXPECT_THAT(headline(), HasSubstr("Ready"));
  EXPECT_FALSE(panel->report());
  for (const char* one : {"save_extended", "use_extended", "export_report"})
    EXPECT_FALSE(button(one)->isVisible()) << one;
  panel->choose({.recordings = {"/a/one.csv"}});
  EXPECT_THAT(headline(), HasSubstr("Found")) << "nothing is lost";
  panel->choose({.recordings = {"/a/one.csv"}, .robot = "/a/other.yaml"});
  EXPECT_THAT(headline(), HasSubstr("Ready"));
}

TEST_F(Diagnosis, SaysWhyThereIsNoReport) {
  show([](const DiagnosisChoice&, base::Progress&) -> Report {
    throw base::InputError({"one.csv", 0, "q_m", {}, "is missing", "Record the motors"});
  });
  panel->choose({.recordings = {"/a/one.csv"}});
  panel->diagnose();
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_THAT(headline(), HasSubstr("Not diagnosed"));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("one.csv: q_m: is missing. Record the motors"));
  EXPECT_FALSE(panel->report());
}

TEST_F(Diagnosis, TheExtendedRobotIsSavedAndUsedWhereItFits) {
  const Report& report = sample(Verdict::kFound);
  panel->showReport(report);
  EXPECT_FALSE(button("use_extended")->isEnabled()) << "no session";
  EXPECT_THAT(button("use_extended")->toolTip().toStdString(), HasSubstr("No session is open"));
  const QString arm = QString::fromStdString(report.extended.name);
  panel->setSession({1, arm});
  EXPECT_FALSE(button("use_extended")->isEnabled()) << "another robot";
  EXPECT_THAT(button("use_extended")->toolTip().toStdString(), HasSubstr("has 3 joints"));
  panel->setSession({3, arm});
  ASSERT_TRUE(button("use_extended")->isEnabled());
  robot::Description used;
  QObject::connect(panel.get(), &DiagnosisPanel::robotChosen, panel.get(),
                   [&](const robot::Description& robot, const QString&) { used = robot; });
  button("use_extended")->click();
  EXPECT_EQ(robot::formatDescription(used), robot::formatDescription(report.extended));

  const QTemporaryDir folder;
  QSignalSpy saved(panel.get(), &DiagnosisPanel::robotSaved);
  panel->saveRobot(folder.filePath("nowhere/robot.yaml"));
  EXPECT_EQ(saved.count(), 0);
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("nowhere/robot.yaml cannot be written"));
  panel->saveRobot(folder.filePath("robot.yaml"));
  EXPECT_EQ(saved.count(), 1);
  EXPECT_EQ(robot::formatDescription(robot::readDescription(folder.filePath("robot.yaml").toStdString())),
            robot::formatDescription(report.extended));
}

TEST_F(Diagnosis, TheExtendedRobotSaysWhichRecordingItIsOf) {
  const QString arm = QString::fromStdString(sample(Verdict::kFound).extended.name);
  panel->choose({.recordings = {"/a/one.csv"}});
  panel->showReport(sample(Verdict::kFound));
  const QPushButton& use = *button("use_extended");
  panel->setSession({3, arm, "/a/one.csv"});
  EXPECT_EQ(use.text(), "Use this robot");
  EXPECT_TRUE(use.isEnabled());
  panel->setSession({3, arm, "/a/two.csv"});
  EXPECT_EQ(use.text(), "Use robot of one.csv") << "another recording is open";
  EXPECT_TRUE(use.isEnabled()) << "of the same arm";
  EXPECT_THAT(use.toolTip().toStdString(), HasSubstr("Diagnosed: one.csv. Open: two.csv"));
  panel->setSession({3, arm, {}});
  EXPECT_EQ(use.text(), "Use robot of one.csv") << "a live arm";
  panel->setSession({3, "another arm", "/a/two.csv"});
  EXPECT_FALSE(use.isEnabled());
  EXPECT_THAT(use.toolTip().toStdString(), HasSubstr("that of the open session is another arm"));
  QString said;
  QObject::connect(panel.get(), &DiagnosisPanel::robotChosen, panel.get(),
                   [&](const robot::Description&, const QString& words) { said = words; });
  panel->setSession({3, arm, "/a/two.csv"});
  button("use_extended")->click();
  EXPECT_THAT(said.toStdString(), HasSubstr("diagnosed: one.csv"));
}

TEST_F(Diagnosis, TheReportIsExportedFigureByFigure) {
  panel->showReport(sample(Verdict::kFound));
  const QTemporaryDir folder;
  QSignalSpy exported(panel.get(), &DiagnosisPanel::exported);
  panel->exportTo(folder.filePath("report"));
  EXPECT_TRUE(panel->busy());
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  ASSERT_EQ(exported.count(), 1) << panel->words().toStdString();
  for (const char* file : {"index.html", "report.json", "robot.yaml", "q2-signatures.svg"})
    EXPECT_TRUE(QFile::exists(folder.filePath("report/") + file)) << file;
  QFile blocked(folder.filePath("blocked"));
  ASSERT_TRUE(blocked.open(QIODevice::WriteOnly));
  panel->exportTo(blocked.fileName());
  EXPECT_FALSE(panel->busy());
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("blocked"));
  EXPECT_EQ(exported.count(), 1);
}

TEST_F(Diagnosis, ANewFolderIsCreatedWhereItsNameIsTyped) {
  panel->showReport(sample(Verdict::kFound));
  const QTemporaryDir folder;
  QSignalSpy exported(panel.get(), &DiagnosisPanel::exported);
  button("export_report")->click();
  auto* dialog = panel->findChild<QFileDialog*>();
  ASSERT_TRUE(dialog);
  dialog->setDirectory(folder.path());
  auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
  ASSERT_TRUE(name);
  name->setText("new/report");
  QTest::keyClick(name, Qt::Key_Return);
  ASSERT_TRUE(waitFor([&] { return exported.count() == 1; })) << panel->words().toStdString();
  EXPECT_TRUE(QFile::exists(folder.filePath("new/report/index.html")));
}

TEST_F(Diagnosis, TheJustRecordedTakesThePlaceOfTheChoice) {
  auto* latest = panel->findChild<QToolButton*>("offered");
  EXPECT_FALSE(latest->isVisible());
  panel->choose({.recordings = {"/a/one.csv"}, .robot = "/a/mine.yaml"});
  panel->offer("/a/session.capstan", "Choose the one just recorded");
  ASSERT_TRUE(latest->isVisible());
  latest->click();
  EXPECT_EQ(panel->choice().recordings, QStringList{"/a/session.capstan"});
  EXPECT_EQ(panel->choice().robot, "/a/mine.yaml");
  EXPECT_FALSE(latest->isVisible()) << "it is chosen";
}

}  // namespace
}  // namespace capstan::widgets
