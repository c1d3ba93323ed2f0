// A run has one number: what the panel shows is what every exported table has.
#include <gtest/gtest.h>

#include <QAction>
#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QtTest/QTest>
#include <cmath>
#include <fstream>
#include <vector>

#include "tests/widgets/picture.h"
#include "widgets/panels/analysis/analysis_panel.h"
#include "widgets/panels/analysis/analysis_table.h"
#include "widgets/panels/analysis/figure_pair.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"

namespace capstan::widgets {
namespace {

using analysis::AnalysisRow;
using analysis::Measure;
using experiments::Estimator;
using Kind = RunChoice::Kind;

template <class Condition>
bool waitFor(Condition&& condition) {
  return QTest::qWaitFor(condition, 90000);
}

/// Lines of a CSV without quoted commas, cell by cell.
std::vector<QStringList> linesOf(const QString& file) {
  QFile csv(file);
  std::vector<QStringList> lines;
  if (!csv.open(QIODevice::ReadOnly)) return lines;
  for (const QString& line : QString::fromUtf8(csv.readAll()).split('\n', Qt::SkipEmptyParts))
    lines.push_back(line.split(','));
  return lines;
}

QString textOf(const QString& file) {
  QFile text(file);
  return text.open(QIODevice::ReadOnly) ? QString::fromUtf8(text.readAll()) : QString();
}

/// Of the line that begins with `keys`, the cell under `column`.
double cell(const std::vector<QStringList>& lines, const QStringList& keys, const QString& column) {
  if (lines.empty()) return std::nan("");
  const int at = lines[0].indexOf(column);
  for (const QStringList& line : lines)
    if (at >= 0 && line.size() > at && line.mid(0, keys.size()) == keys) return line[at].toDouble();
  return std::nan("");
}

class AnalysisNumbers : public testing::Test {
 protected:
  /// A session of which eight seconds are recorded, and then paused.
  void SetUp() override {
    window_ = std::make_unique<MainWindow>(path("settings.ini"));
    window_->bar().setSpeed(10.0);
    window_->resize(1280, 800);
    window_->show();
    window_->activateWindow();
    simulation::SimulationRequest request;
    request.trajectory = "sinusoid";
    request.duration = 600.0;
    request.images = false;
    window_->open(SourceChoice::ofSimulation(request));
    ASSERT_TRUE(waitFor([&] { return window_->link().running(); }));
    QDir(folder_.path()).mkdir("recorded");
    window_->link().toggleRecording(path("recorded"));
    ASSERT_TRUE(waitFor([&] { return window_->link().runner()->status().t > 8.0; }));
    window_->link().setRunning(false);
    ASSERT_TRUE(waitFor([&] { return !window_->link().running(); }));
    window_->link().toggleRecording(path("recorded"));
    ASSERT_TRUE(waitFor([&] { return !window_->link().recording(); }));
    const QStringList files = QDir(path("recorded")).entryList({"*.capstan"});
    ASSERT_EQ(files.size(), 1);
    recorded_ = path("recorded/" + files.front());
    robot::Description robot = window_->link().runner()->info().robot;
    robot.drives[0].link_radius *= 0.935;
    std::ofstream(path("mine.yaml").toStdString()) << robot::formatDescription(robot);
    window_->action("analyse")->trigger();
  }
  QString path(const QString& name) const { return folder_.filePath(name); }
  AnalysisPanel& panel() { return window_->analysis(); }
  void chooseBoth() {
    panel().choose(0, {.kind = Kind::kSession});
    panel().choose(1, {.kind = Kind::kRecording, .path = recorded_, .robot = path("mine.yaml")});
    ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
    ASSERT_EQ(panel().analysis().rows.size(), 6U) << panel().words().toStdString();
  }

  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
  QString recorded_;
};

TEST_F(AnalysisNumbers, OfTheScreenAreThoseOfEveryExportedTable) {
  chooseBoth();
  const QStringList notes = panel().table().noteWords().split('\n');
  ASSERT_EQ(notes.size(), 3) << "recording began a little after the session";
  EXPECT_EQ(notes[0], "A: kinematics and UKF of RAVEN-II left");
  EXPECT_EQ(notes[1], "B: kinematics and UKF of mine.yaml");
  EXPECT_TRUE(notes[2].startsWith("intervals and P: of the ")) << notes[2].toStdString();
  test::grab(*window_, "analysis_numbers");
  panel().exportAllTo(path("all"), {180.0, 240.0});
  ASSERT_TRUE(waitFor([&] { return !panel().busy(); }));
  const auto session = linesOf(path("all/session-table-trials.csv"));
  const QString name = QFileInfo(recorded_).completeBaseName() + "-mine";
  const auto recording = linesOf(path("all/" + name + "-table-trials.csv"));
  const auto comparison = linesOf(path("all/comparison-table.csv"));
  ASSERT_FALSE(session.empty());
  ASSERT_FALSE(recording.empty());
  for (const QString figure : {"session-histogram-session", "comparison-boxplot"})
    EXPECT_TRUE(textOf(path("all/" + figure + ".svg")).contains("kinematics and UKF of"))
        << figure.toStdString();
  EXPECT_FALSE(comparison.empty()) << "Export all leaves the comparison out";
  for (const char* figure : {"comparison-histogram.pdf", "comparison-boxplot.pdf"})
    EXPECT_TRUE(QFile::exists(path("all/") + figure)) << figure;
  for (const AnalysisRow& row : panel().analysis().rows) {
    const auto of = [&](const std::vector<QStringList>& lines, const QString& column) {
      for (const QStringList& line : lines)
        if (line.size() > 3 && line[2].startsWith(QString::number(row.joint + 1)))
          return cell(lines, {line[0], line[1], line[2]}, column);
      return std::nan("");
    };
    const QString estimator = row.estimator == Estimator::kUkf ? "UKF" : "kinematic";
    const double a = row.a.of(Measure::kRms), b = row.b.of(Measure::kRms);
    EXPECT_NEAR(of(session, estimator), a, 1e-9) << "A, q" << row.joint + 1 << ' ' << estimator.toStdString();
    EXPECT_NEAR(of(recording, estimator), b, 1e-9)
        << "B, q" << row.joint + 1 << ' ' << estimator.toStdString();
    for (const Measure measure : analysis::kMeasures) {
      const QStringList keys = {QStringLiteral("q%1").arg(row.joint + 1), estimator,
                                QString::fromStdString(std::string(base::nameOf(measure)))};
      EXPECT_NEAR(cell(comparison, keys, "A"), row.a.of(measure), 1e-12) << keys.join(' ').toStdString();
      EXPECT_NEAR(cell(comparison, keys, "B"), row.b.of(measure), 1e-12) << keys.join(' ').toStdString();
      EXPECT_NEAR(cell(comparison, keys, "95 % from"), row.of(measure).low, 1e-12);
      EXPECT_NEAR(cell(comparison, keys, "95 % to"), row.of(measure).high, 1e-12);
    }
  }
}

TEST_F(AnalysisNumbers, AreOfEverySampleAndThoseOfTheErrorTable) {
  panel().choose(0, {.kind = Kind::kSession});
  ASSERT_TRUE(waitFor([&] { return panel().settled(); }));
  ASSERT_TRUE(waitFor([&] {
    return window_->link().runner()->report().errors.ukf().count() >= panel().analysis().rows.at(0).a.n;
  }));
  const auto errors = window_->link().runner()->report().errors;
  for (const AnalysisRow& row : panel().analysis().rows) {
    const auto& all = row.estimator == Estimator::kUkf ? errors.ukf() : errors.kinematic();
    EXPECT_EQ(row.a.n, all.count()) << "n " << row.joint;
    const double whole = all.value()(row.joint) * (row.joint < 2 ? 180.0 / M_PI : 1e3);
    EXPECT_NEAR(row.a.of(Measure::kRms) / whole, 1.0, 1e-12) << row.joint;
  }
}

TEST_F(AnalysisNumbers, PairAReplayWithItsFile) {
  window_->open(SourceChoice::ofFile(recorded_));
  ASSERT_TRUE(waitFor([&] { return window_->link().running() && !window_->link().runner()->info().live; }));
  ASSERT_TRUE(waitFor([&] { return window_->link().ended(); }));
  chooseBoth();
  for (const AnalysisRow& row : panel().analysis().rows) {
    EXPECT_TRUE(row.paired) << row.joint;
    EXPECT_EQ(row.a.n, row.b.n) << "every sample of the file, on both sides";
  }
  EXPECT_EQ(panel().analysis().robots_a, "kinematics and UKF of RAVEN-II left");
}

TEST_F(AnalysisNumbers, PairTheSessionWithItsOwnFile) {
  chooseBoth();
  for (const AnalysisRow& row : panel().analysis().rows) EXPECT_TRUE(row.paired) << row.joint;
}

}  // namespace
}  // namespace capstan::widgets
