// The learning panel without a window around it, on tables whose flaws are known.
#include "widgets/panels/learning/learning_panel.h"
#include "tests/support/folders.h"

#include <gmock/gmock.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSignalSpy>
#include <QSlider>
#include <QTemporaryDir>
#include <QTreeWidget>
#include <QtTest/QTest>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/learning/model/correction_file.h"
#include "tests/support/sample_poses.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/learning/ablation_view.h"
#include "widgets/panels/learning/clouds_view.h"
#include "widgets/panels/learning/confidence_view.h"
#include "widgets/panels/learning/curve_view.h"
#include "widgets/panels/learning/errors_view.h"
#include "widgets/panels/learning/learning_figures.h"
#include "widgets/panels/learning/learning_pages.h"
#include "widgets/panels/learning/reliability_view.h"
#include "widgets/panels/learning/stages_view.h"
#include "widgets/panels/learning/trajectory_view.h"
#include "widgets/panels/work/figure_sheet.h"
#include "widgets/scene/cloud_view.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;
using testing::SamplePoses;

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 180000);
}

LearningSettings quick() {
  LearningSettings settings;
  settings.learning.correction.likelihood_points = 200;
  settings.learning.correction.inducing_points = 200;
  return settings;
}

class Learning : public ::testing::Test {
 protected:
  void SetUp() override { show(quick()); }
  void show(const LearningSettings& settings) {
    panel = std::make_unique<LearningPanel>(settings);
    panel->resize(1100, 820);
    panel->show();
    QApplication::setActiveWindow(panel.get());  // for its keys
  }
  QString table(const char* name, const SamplePoses& sample = {}) {
    testing::writeSamplePoses(folder.filePath(name).toStdString(), sample);
    return folder.filePath(name);
  }
  void read(const QString& path) {
    panel->choose({.tables = {path}});
    ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  }
  void readAndTrain() {
    read(table("poses.csv"));
    QTest::keyClick(panel.get(), Qt::Key_F5);
    ASSERT_TRUE(panel->busy());
    ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
    ASSERT_TRUE(panel->results().evaluation) << panel->summary().toStdString();
  }
  QPushButton* button(const char* name) { return panel->findChild<QPushButton*>(name); }
  std::string headline() { return panel->headline().toStdString(); }
  LearningPages& pages() { return panel->pages(); }
  void pictures(const char* state) {
    for (int page = 0; page < pages().count(); ++page) {
      pages().setCurrentIndex(page);
      test::grab(*panel, QStringLiteral("learning_panel_%1_%2").arg(state).arg(page));
    }
  }

  QTemporaryDir folder;
  std::unique_ptr<LearningPanel> panel;
};

TEST_F(Learning, BeginsWithAQuestionAndNothingToPress) {
  EXPECT_THAT(headline(), HasSubstr("How far from its command"));
  EXPECT_FALSE(button("train")->isEnabled());
  EXPECT_FALSE(button("export_learning")->isVisible());
  EXPECT_FALSE(pages().isVisible());
  test::grab(*panel, "learning_panel_empty");
}

TEST_F(Learning, EveryStageHasItsNumbers) {
  read(table("poses.csv"));
  EXPECT_THAT(headline(), HasSubstr("states accepted; with a rigid offset"));
  const std::string lines = pages().stages().lines().join('\n').toStdString();
  EXPECT_THAT(lines, HasSubstr("camera: poses of 1,200 rows | 1,180"));
  EXPECT_THAT(lines, HasSubstr("placeholder | 20"));
  EXPECT_THAT(lines, HasSubstr("lag behind the command, ± σ | "));
  EXPECT_NEAR(panel->results().stages->clock_offset.clock_offset, 0.04, 0.006);
  EXPECT_THAT(lines, HasSubstr("trajectories rejected whole, of 20 | 1"));
  EXPECT_THAT(lines, HasSubstr("distance, median, before and after"));
  QTreeWidget& list = pages().trajectories().list();
  ASSERT_EQ(list.topLevelItemCount(), 20);
  EXPECT_EQ(list.topLevelItem(0)->text(0), "task 0, 0");
  EXPECT_EQ(list.topLevelItem(0)->toolTip(0), "task 0, trajectory 0");
  EXPECT_EQ(list.topLevelItem(19)->text(2), "100 %");
  pictures("read");
}

TEST_F(Learning, ATrajectoryThatIsClickedIsSeen) {
  read(table("poses.csv"));
  pages().setCurrentWidget(&pages().trajectories());
  QTreeWidget& list = pages().trajectories().list();
  list.sortByColumn(2, Qt::DescendingOrder);
  EXPECT_EQ(list.topLevelItem(0)->text(0), "task 1, 9") << "all of it was rejected";
  list.setCurrentItem(list.topLevelItem(0));
  const auto* figure = qobject_cast<PoseTraceFigure*>(pages().trajectories().sheet().figure());
  ASSERT_TRUE(figure);
  EXPECT_EQ(figure->data().title, "task 1, trajectory 9");
  EXPECT_EQ(std::count(figure->data().rejected.begin(), figure->data().rejected.end(), false), 0);
  QTest::keyClick(panel.get(), Qt::Key_Down, Qt::AltModifier);
  EXPECT_EQ(list.currentItem(), list.topLevelItem(1));
}

TEST_F(Learning, TrainsInTheBackgroundAndJudgesOnTrajectoriesHeldOut) {
  readAndTrain();
  EXPECT_THAT(headline(), HasSubstr("Corrected: position"));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("4 of 20 trajectories"));
  pages().setCurrentWidget(&pages().errors());
  const auto* figure = qobject_cast<BoxplotFigure*>(pages().errors().sheet().figure());
  ASSERT_TRUE(figure);
  ASSERT_EQ(figure->data().panels.size(), 8U) << "distance, x, y, z, angle, yaw, pitch, roll";
  for (const BoxplotPanel& one : figure->data().panels) {
    ASSERT_EQ(one.groups.at(0).boxes.size(), 3U);
    EXPECT_LT(one.groups[0].boxes[2].statistics.median, one.groups[0].boxes[0].statistics.median)
        << one.title.toStdString();
  }
  EXPECT_EQ(figure->data().panels[0].unit, "mm");
  EXPECT_EQ(figure->data().panels[4].unit, "deg");
  const std::string lines = pages().stages().lines().join('\n').toStdString();
  EXPECT_THAT(lines, HasSubstr("inducing points | 3 × 200"));
  EXPECT_THAT(lines, HasSubstr(QStringLiteral("… down-weighted | %1\n")
                                   .arg(panel->results().learned->weighing.down_weighted)
                                   .toStdString()));
  EXPECT_THAT(lines, HasSubstr("Errors on 4 held-out trajectories"));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("Learned from pose"));
  const auto* reliability = qobject_cast<ReliabilityFigure*>(pages().reliability().sheet().figure());
  ASSERT_TRUE(reliability);
  EXPECT_EQ(reliability->data().stated.states(), panel->results().evaluation->test.clean[2].distance.size());
  EXPECT_EQ(reliability->numbers().at(0).csv.substr(0, 20), "stated,sigmas,x,y,z,");
  for (const PointCloud& cloud : pages().clouds().view().clouds())
    EXPECT_FALSE(cloud.points.empty()) << cloud.name.toStdString();
  ASSERT_TRUE(waitFor([&] { return pages().confidence().slice() != nullptr; }));
  pictures("trained");
}

TEST_F(Learning, TheSliceFollowsAxisAndDepth) {
  readAndTrain();
  ConfidenceView& view = pages().confidence();
  ASSERT_TRUE(waitFor([&] { return view.slice() != nullptr; }));
  EXPECT_EQ(view.slice()->axis, 2);
  const double middle = view.slice()->at;
  view.depth().setValue(view.depth().maximum());
  ASSERT_TRUE(waitFor([&] { return view.slice() && view.slice()->at > middle + 1e-3; }));
  pages().setCurrentWidget(&view);
  QTest::keyClick(panel.get(), Qt::Key_A, Qt::AltModifier);
  ASSERT_TRUE(waitFor([&] { return view.slice() && view.slice()->axis == 0; }));
}

TEST_F(Learning, TrainingIsCancelledAndWhatWasThereStays) {
  LearningSettings slow;
  slow.learning.correction.fit.tolerance = 0.0;
  slow.learning.correction.fit.iterations = 100000;
  show(slow);
  read(table("poses.csv"));
  QTest::keyClick(panel.get(), Qt::Key_F5);
  ASSERT_TRUE(panel->busy());
  EXPECT_EQ(button("train")->text(), "Cancel");
  EXPECT_FALSE(button("export_learning")->isVisible());
  QTest::keyClick(panel.get(), Qt::Key_Escape);
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("Cancelled"));
  EXPECT_FALSE(panel->results().evaluation);
  EXPECT_THAT(headline(), HasSubstr("states accepted")) << "the stages stay";
  EXPECT_EQ(button("train")->text(), "Train");
}

TEST_F(Learning, TheAblationTableStandsBesideThePapersNumbers) {
  read(table("poses.csv"));
  pages().ablation().setSplits(1);
  QTest::keyClick(panel.get(), Qt::Key_F6);
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  ASSERT_TRUE(panel->results().study);
  EXPECT_EQ(pages().currentWidget(), &pages().ablation());
  const QStringList lines = pages().ablation().lines();
  ASSERT_EQ(lines.size(), 26) << "six methods, ours and the paper's, and four of ours";
  EXPECT_THAT(lines[17].toStdString(), HasSubstr("paper | 1.4 ± 1.7 | 1.4 ± 1.5 | 1.1 ± 1.2"));
  const auto& all = panel->results().study->clean[5];
  EXPECT_THAT(lines[16].toStdString(),
              HasSubstr(QStringLiteral("ours | %1 ± ").arg(1e3 * all.mean[0], 0, 'f', 1).toStdString()));
  panel->findChild<QComboBox*>("ablation_states")->setCurrentIndex(1);
  EXPECT_THAT(pages().ablation().lines()[17].toStdString(), HasSubstr("paper | 1.6 ± 1.6"));
  test::grab(*panel, "learning_panel_ablation");
}

TEST_F(Learning, TheLearningCurveFalls) {
  read(table("poses.csv"));
  QTest::keyClick(panel.get(), Qt::Key_F7);
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  const auto* figure = qobject_cast<LearningCurveFigure*>(pages().curve().sheet().figure());
  ASSERT_TRUE(figure) << panel->summary().toStdString();
  ASSERT_EQ(figure->data().curve.points.size(), 6U);
  test::grab(*panel, "learning_panel_curve");
}

TEST_F(Learning, ABadTableIsNamedWithItsRemedyAndAnotherOneRead) {
  base::writeTextFile(folder.filePath("bad.csv").toStdString(), "traj,t_cam_s,cam_x\n0,0,0\n");
  read(folder.filePath("bad.csv"));
  EXPECT_THAT(headline(), HasSubstr("Not read"));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("bad.csv:1: cam_y: this column is missing"));
  EXPECT_FALSE(pages().isVisible());
  test::grab(*panel, "learning_panel_bad");
  read(folder.filePath("nowhere.csv"));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("nowhere.csv"));

  SamplePoses sample;
  sample.command = false;
  read(table("robot.csv", sample));
  EXPECT_THAT(panel->summary().toStdString(), HasSubstr("command: these tables have no such poses"));
  auto* commanded = panel->findChild<QComboBox*>("towards");
  QTest::keyClick(commanded, Qt::Key_Down);
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_EQ(panel->choice().towards, learning::StreamKind::kRobot);
  EXPECT_THAT(headline(), HasSubstr("states accepted"));
}

TEST_F(Learning, OtherTablesForgetWhatWasLearned) {
  readAndTrain();
  SamplePoses other;
  other.seed = 2;
  panel->choose({.tables = {table("poses.csv"), table("more.csv", other)}});
  EXPECT_FALSE(panel->results().evaluation);
  panel->choose(panel->choice());  // while it is being read
  ASSERT_TRUE(waitFor([&] { return !panel->busy() && panel->results().stages; }));
  ASSERT_EQ(pages().trajectories().list().topLevelItemCount(), 40);
  EXPECT_EQ(pages().trajectories().list().topLevelItem(39)->text(0), "more, task 1, 9");
}

TEST_F(Learning, WhatIsExportedIsReadBack) {
  readAndTrain();
  pages().ablation().setSplits(1);
  panel->runAblation();
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  ASSERT_TRUE(waitFor([&] { return pages().confidence().slice() != nullptr; }));
  QSignalSpy exported(panel.get(), &LearningPanel::exported);
  panel->exportTo(folder.filePath("out"));
  EXPECT_TRUE(panel->busy());
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  ASSERT_EQ(exported.count(), 1) << panel->words().toStdString();
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("files in"));
  for (const char* name : {"lag", "trajectory", "errors-clean", "errors-all", "confidence", "reliability"})
    for (const char* ending : {".pdf", ".svg", ".png", ".csv"})
      EXPECT_GT(QFile(folder.filePath("out/") + name + ending).size(), 100) << name << ending;
  const std::string rejected = base::readTextFile(folder.filePath("out/rejected.csv").toStdString());
  EXPECT_THAT(rejected,
              HasSubstr("trajectory,stream,line,reason\n\"task 0, trajectory 0\",camera,42,placeholder"));
  const std::string ablation = base::readTextFile(folder.filePath("out/ablation-clean.csv").toStdString());
  EXPECT_THAT(ablation, HasSubstr("offset, GP, velocity, cleaning"));
  EXPECT_THAT(ablation, HasSubstr("x [mm]"));

  QFile blocked(folder.filePath("blocked"));
  ASSERT_TRUE(blocked.open(QIODevice::WriteOnly));
  panel->exportTo(blocked.fileName());
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("blocked"));
  EXPECT_EQ(exported.count(), 1);
}

TEST_F(Learning, AModelIsSavedWithWhatItWasLearnedFrom) {
  readAndTrain();
  ASSERT_TRUE(button("save_model")->isVisible());
  QSignalSpy saved(panel.get(), &LearningPanel::modelSaved);
  const QString path = folder.filePath("arm.correction");
  panel->saveModel(path);
  EXPECT_EQ(saved.count(), 1);
  const learning::CorrectionFile file = learning::readCorrection(path.toStdString());
  EXPECT_FALSE(file.model.processes().empty());
  ASSERT_EQ(file.source.files.size(), 1U);
  EXPECT_EQ(file.source.files[0], panel->choice().tables[0].toStdString());
  EXPECT_GT(file.source.states, 100U);
  panel->saveModel("/nowhere/arm.correction");
  EXPECT_EQ(saved.count(), 1);
  EXPECT_THAT(panel->words().toStdString(), HasSubstr("/nowhere"));
}

// Bytes of one file, and errors, from two programs.
TEST_F(Learning, ModelAndErrorsAreThoseOfTheCommandLine) {
  LearningSettings settings;
  settings.learning.correction.inducing_points = 60;
  settings.learning.correction.members = 1;
  show(settings);
  SamplePoses monday, tuesday;
  monday.trajectories = tuesday.trajectories = 4;
  tuesday.seed = 2;
  const QStringList tables = {table("monday.csv", monday), table("tuesday.csv", tuesday)};
  panel->choose({.tables = tables});
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  panel->train();
  ASSERT_TRUE(waitFor([&] { return !panel->busy(); }));
  ASSERT_TRUE(panel->results().evaluation) << panel->summary().toStdString();
  panel->saveModel(folder.filePath("window.correction"));
  QProcess process;
  process.start(
      QString::fromStdString(capstan::test::commandLineProgram()),
      {"learn", "--train", tables[0], tables[1], "--inducing", "60", "--members", "1", "--hold-out", "20",
       "--model", folder.filePath("line.correction"), "--json", folder.filePath("line.json")});
  ASSERT_TRUE(process.waitForFinished(240000));
  ASSERT_EQ(process.exitCode(), 0) << process.readAllStandardError().toStdString();
  const auto bytes = [&](const char* name) {
    QFile file(folder.filePath(name));
    EXPECT_TRUE(file.open(QIODevice::ReadOnly)) << name;
    return file.readAll();
  };
  const QByteArray window = bytes("window.correction"), line = bytes("line.correction");
  EXPECT_GT(window.size(), 10000);
  EXPECT_TRUE(window == line) << "sizes " << window.size() << " and " << line.size() << "\n"
                              << window.left(600).toStdString() << "\n"
                              << line.left(600).toStdString();
  const auto held_out = nlohmann::json::parse(bytes("line.json").toStdString())["held_out"];
  const learning::HeldOutEvaluation& evaluation = *panel->results().evaluation;
  EXPECT_EQ(held_out["held_out"], evaluation.motions_held);
  EXPECT_EQ(held_out["all"]["states"], evaluation.test.states);
  EXPECT_EQ(held_out["clean"]["corrected"]["distance"]["mean"], evaluation.test.clean[2].summed().distance);
}

TEST_F(Learning, TheChoiceIsKeptAndReadWhenItIsLookedAt) {
  const LearningChoice choice{.tables = {table("poses.csv")}, .towards = learning::StreamKind::kRobot};
  panel->choose(choice);
  pages().ablation().setSplits(3);
  QSettings settings(folder.filePath("settings.ini"), QSettings::IniFormat);
  panel->save(settings);
  LearningPanel other(quick());
  other.restore(settings);
  EXPECT_EQ(other.choice(), choice);
  EXPECT_EQ(other.pages().ablation().splits(), 3);
  EXPECT_FALSE(other.busy()) << "nobody looks";
  other.show();
  EXPECT_TRUE(other.busy());
  ASSERT_TRUE(waitFor([&] { return other.results().stages != nullptr; }));
}

}  // namespace
}  // namespace capstan::widgets
