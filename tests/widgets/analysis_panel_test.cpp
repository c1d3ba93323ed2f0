#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileDialog>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <QToolButton>
#include <QtTest/QTest>
#include <fstream>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/recording/export.h"
#include "core/simulation/simulation_request.h"
#include "core/stats/rms.h"
#include "tests/widgets/analysed_panel.h"
#include "tests/widgets/figures/layout_check.h"
#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/analysis_table.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/panels/analysis/options_bar.h"

namespace capstan::widgets {
namespace {

using analysis::Measure;
using experiments::Estimator;
using Kind = RunChoice::Kind;
using ::testing::HasSubstr;

QString shown(double value, int decimals) {
  return QString::number(value, 'f', decimals).replace(QLatin1Char('-'), QChar(0x2212));
}

TEST_F(Analysed, OneRecordingHasFiguresAndNumbers) {
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  ASSERT_TRUE(panel.figures().histogram());
  const auto& results = panel.figures().histogram()->results();
  ASSERT_EQ(results.size(), 3U);
  base::Progress progress;
  const auto run = analysis::trackErrors(path("trial.capstan").toStdString(), {}, progress);
  for (int joint = 0; joint < 3; ++joint) {
    const auto values = analysis::selectedErrors(run, Estimator::kUkf, joint, {}).value;
    ASSERT_GT(values.size(), 700U);
    EXPECT_EQ(results[static_cast<std::size_t>(joint)][1].n, values.size());
    EXPECT_EQ(cell(Measure::kRms, joint, Estimator::kUkf, AnalysisTable::kA),
              shown(stats::rms(values), analysis::decimalsOf(panel.analysis())));
    EXPECT_EQ(cell(Measure::kRms, joint, Estimator::kUkf, AnalysisTable::kCountA),
              QString::number(values.size()));
  }
  // The camera is off: its samples would be another number.
  EXPECT_FALSE(panel.table().line(Measure::kRms, 0, Estimator::kCamera));
  EXPECT_TRUE(cell(Measure::kRms, 0, Estimator::kUkf, AnalysisTable::kInterval).contains("…"));
  EXPECT_TRUE(panel.table().isColumnHidden(AnalysisTable::kB));
  test::grab(panel, "analysis_one");
}

TEST_F(Analysed, TheFirstAnalysisIsLaidOutAsAfterAResize) {
  for (const bool two : {false, true}) {
    AnalysisPanel first;
    first.resize(1015, 960);  // in a window of 1920 × 1080
    first.show();
    first.choose(0, recording());
    if (two) first.choose(1, recording(path("mine.yaml")));
    ASSERT_TRUE(QTest::qWaitFor([&] { return first.settled(); }, kPatience));
    QApplication::processEvents();
    PanelFigure* figures[] = {first.figures().findChild<HistogramFigure*>(),
                              first.figures().findChild<BoxplotFigure*>()};
    ASSERT_TRUE(figures[0] && figures[1]);
    QImage before[2];
    for (const int i : {0, 1}) {
      EXPECT_EQ(test::layoutFaults(*figures[i]).join("; ").toStdString(), "") << two;
      before[i] = test::grab(*figures[i], QString("analysis_first_%1_%2").arg(two).arg(i));
    }
    test::grab(first, QString("analysis_first_%1").arg(two));
    first.resize(1016, 961);
    QApplication::processEvents();
    first.resize(1015, 960);
    for (const int i : {0, 1})
      EXPECT_EQ(before[i], test::grab(*figures[i], QString("analysis_resized_%1_%2").arg(two).arg(i))) << two;
  }
}

TEST_F(Analysed, ARunAgainstItselfHasNoDifference) {
  panel.choose(0, recording());
  panel.choose(1, recording());
  panel.options().setJoint(1);
  ASSERT_TRUE(settled());
  EXPECT_TRUE(panel.analysis().intervals);
  ASSERT_EQ(panel.analysis().rows.size(), 2U);
  for (const Measure measure : analysis::kMeasures) {
    EXPECT_EQ(cell(measure, 1, Estimator::kUkf, AnalysisTable::kA),
              cell(measure, 1, Estimator::kUkf, AnalysisTable::kB));
    const QString difference = cell(measure, 1, Estimator::kUkf, AnalysisTable::kDifference);
    EXPECT_THAT(difference.toStdString(), ::testing::MatchesRegex("0\\.0+"));
    EXPECT_EQ(cell(measure, 1, Estimator::kUkf, AnalysisTable::kInterval),
              QString("%1 … %1").arg(difference));
  }
  EXPECT_EQ(cell(Measure::kMean, 1, Estimator::kUkf, AnalysisTable::kP), "–");
  EXPECT_EQ(panel.figures().histogram()->data().panels.size(), 2U);  // an estimator each
  EXPECT_EQ(panel.figures().boxplot()->data().panels.at(0).groups.size(), 2U);
}

TEST(AnalysisSeries, RunsAreToldApartWithoutColour) {
  for (const Estimator estimator : {Estimator::kKinematic, Estimator::kCamera, Estimator::kUkf}) {
    const auto a = SeriesStyle::of({quantityOf(estimator), 0, "A"}, Theme::light());
    const auto b = SeriesStyle::of({quantityOf(estimator), 1, "B"}, Theme::light());
    EXPECT_NE(b.second_hatch, Hatch::kNone);
    EXPECT_NE(b.second_hatch, b.hatch);  // crossed
    EXPECT_EQ(a.second_hatch, Hatch::kNone);
  }
}

TEST_F(Analysed, AnotherRobotMakesADifference) {
  panel.choose(0, recording());
  panel.choose(1, recording(path("mine.yaml")));
  panel.options().setJoint(0);
  ASSERT_TRUE(settled());
  const auto& row = panel.analysis().rows.at(0);
  EXPECT_TRUE(row.paired);
  EXPECT_FALSE(panel.table().isColumnHidden(AnalysisTable::kB));
  EXPECT_TRUE(panel.table().isColumnHidden(AnalysisTable::kCountB));  // as many as of A
  EXPECT_TRUE(row.of(Measure::kRms).clear());
  EXPECT_TRUE(
      panel.table().line(Measure::kRms, 0, Estimator::kKinematic)->font(AnalysisTable::kDifference).bold());
  test::grab(panel, "analysis_two");
}

TEST_F(Analysed, FiguresHaveMostOfTheHeight) {
  for (const int height : {640, 900, 640}) {
    panel.resize(700, height);
    EXPECT_GT(panel.figures().height(), 1.4 * panel.table().height()) << height;
  }
}

TEST_F(Analysed, OptionsChangeWhatIsShown) {
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  EXPECT_EQ(panel.figures().boxplot()->data().quantity, "signed error");
  panel.findChild<QCheckBox*>("camera")->click();
  panel.findChild<QCheckBox*>("kinematic")->click();
  panel.findChild<QComboBox*>("error")->setCurrentIndex(1);
  panel.findChild<QComboBox*>("joint")->setCurrentIndex(3);
  ASSERT_TRUE(settled());
  ASSERT_EQ(panel.analysis().rows.size(), 2U);
  EXPECT_EQ(panel.analysis().rows[0].estimator, Estimator::kCamera);
  EXPECT_EQ(panel.figures().histogram()->data().quantity, "|error|");
  EXPECT_TRUE(panel.figures().histogram()->data().density);
  EXPECT_EQ(panel.figures().histogram()->data().panels.at(0).unit, "mm");
  panel.findChild<QComboBox*>("time")->setCurrentIndex(1);
  ASSERT_TRUE(settled());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("leaves no sample"));
  EXPECT_FALSE(panel.figures().histogram());
}

TEST_F(Analysed, BadFilesSayWhatToDo) {
  std::ofstream(path("plain.csv").toStdString()) << "t,q_m1,q_m2,q_m3\n0,1,2,3\n0.001,1,2,3\n";
  panel.choose(0, {.kind = Kind::kRecording, .path = path("plain.csv")});
  ASSERT_TRUE(settled());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("A: "));
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("Choose a recording with a reference"));
  panel.choose(0, {.kind = Kind::kResults, .path = path("")});
  ASSERT_TRUE(settled());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("results.json"));
  EXPECT_FALSE(panel.figures().histogram());
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  EXPECT_EQ(panel.words(), "");
  EXPECT_TRUE(panel.figures().histogram());
}

TEST_F(Analysed, CancelStopsAndRefreshGoesOn) {
  panel.choose(0, recording());
  ASSERT_TRUE(panel.busy());
  QTest::keyClick(&panel, Qt::Key_Escape);
  panel.cancel();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !panel.busy(); }, kPatience));
  QTest::qWait(50);
  EXPECT_FALSE(panel.busy());
  EXPECT_FALSE(panel.settled());
  EXPECT_FALSE(panel.figures().histogram());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("Cancelled"));
  panel.refresh();
  ASSERT_TRUE(settled());
  EXPECT_TRUE(panel.figures().histogram());
}

TEST_F(Analysed, TheNewestChoiceWins) {
  panel.choose(0, recording());
  panel.choose(0, recording(path("mine.yaml")));
  ASSERT_TRUE(settled());
  EXPECT_EQ(panel.analysis().title_a, "trial.capstan, mine");
}

TEST_F(Analysed, TrialsOfResultsAreOffered) {
  experiments::Results results;
  results.name = "C";
  for (const char* name : {"1", "2"}) {
    auto& trial = results.trials.emplace_back();
    trial.name = name;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d error = Eigen::Vector3d::Constant(1e-3 * std::sin(0.1 * i + trial.name[0]));
      trial.errors.push_back({0.01 * i, error, error, 0.5 * error, i % 2 == 0});
    }
  }
  experiments::writeResults(results, path("C").toStdString());
  panel.choose(0, {.kind = Kind::kResults, .path = path("C"), .trial = "2"});
  ASSERT_TRUE(settled());
  auto* trials = panel.picker(0).findChild<QComboBox*>("trial");
  EXPECT_TRUE(trials->isVisible());
  EXPECT_EQ(trials->count(), 2);
  EXPECT_EQ(trials->currentText(), "2");
  EXPECT_EQ(panel.analysis().title_a, "C, 2");
  QTest::keyClick(trials, Qt::Key_Up);
  ASSERT_TRUE(settled());
  EXPECT_EQ(panel.analysis().title_a, "C, 1");
}

TEST_F(Analysed, TheSessionSoFarIsAskedFor) {
  panel.choose(0, {.kind = Kind::kSession});
  ASSERT_TRUE(settled());
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("Open a source first"));
  int asked = 0;
  panel.setSession([&asked] {
    ++asked;
    analysis::ErrorRun run{.title = "live"};
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d error = Eigen::Vector3d::Constant(1e-3 * std::cos(0.3 * i * asked));
      run.errors.push_back({0.01 * i, error, error, 0.5 * error, false});
    }
    return run;
  });
  panel.refresh();
  ASSERT_TRUE(settled());
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(cell(Measure::kRms, 0, Estimator::kUkf, AnalysisTable::kCountA), "300");
  panel.hide();
  panel.refresh();  // nothing is computed where nobody looks
  QTest::qWait(50);
  EXPECT_EQ(asked, 1);
  panel.show();
  ASSERT_TRUE(settled());
  EXPECT_EQ(asked, 2);
}

TEST_F(Analysed, RemembersWhatWasChosen) {
  QSettings settings(path("settings.ini"), QSettings::IniFormat);
  panel.choose(0, recording(path("mine.yaml")));
  panel.choose(1, {.kind = Kind::kSession});
  panel.options().setJoint(2);
  panel.findChild<QCheckBox*>("camera")->setChecked(true);
  panel.save(settings);
  AnalysisPanel other;
  other.restore(settings);
  EXPECT_EQ(other.picker(0).choice(), recording(path("mine.yaml")));
  EXPECT_EQ(other.picker(1).choice().kind, Kind::kSession);
  EXPECT_EQ(other.options().options(), panel.options().options());
  EXPECT_EQ(other.options().options().joint, 2);
}

TEST_F(Analysed, ExportsFiguresAndTable) {
  panel.choose(0, recording());
  ASSERT_TRUE(settled());
  panel.exportTo(path("out/none"), {});
  EXPECT_THAT(panel.words().toStdString(), HasSubstr("none"));
  panel.exportTo(path("errors.pdf"), {.width_mm = 180.0, .height_mm = 120.0});
  for (const char* ending :
       {"-histogram.pdf", "-histogram.svg", "-histogram.png", "-histogram.csv", "-boxplot.pdf",
        "-boxplot.svg", "-boxplot.png", "-boxplot.csv", "-table.md", "-table.tex", "-table.csv"})
    EXPECT_TRUE(QFileInfo::exists(path("errors") + ending)) << ending;
  const std::string table = base::readTextFile(path("errors-table.md").toStdString());
  EXPECT_THAT(table, HasSubstr("trial.capstan"));
  EXPECT_THAT(table, HasSubstr(cell(Measure::kRms, 0, Estimator::kUkf, AnalysisTable::kA).toStdString()));
}

}  // namespace
}  // namespace capstan::widgets
