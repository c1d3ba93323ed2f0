// What the window diagnoses is what the command line diagnoses: two programs, one report.
#include <gmock/gmock.h>

#include <QFile>
#include <QProcess>
#include <QTemporaryDir>
#include <QtTest/QTest>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/diagnosis/report/report_json.h"
#include "tests/app/diagnose_recording.h"
#include "tests/core/diagnosis/sampled_poses.h"
#include "tests/support/folders.h"
#include "widgets/panels/diagnosis/diagnosis_panel.h"

namespace capstan::widgets {
namespace {

using ::testing::HasSubstr;

/// How long each stage took is another number in each run; the command line adds the schema's version.
nlohmann::json withoutTimes(nlohmann::json report) {
  EXPECT_EQ(report.erase("stages"), 1U);
  report.erase("schema");
  return report;
}

class DiagnosisRuns : public ::testing::Test {
 protected:
  std::string path(const char* name) const { return folder_.filePath(name).toStdString(); }
  /// What the panel shows of `file`, as JSON.
  nlohmann::json window(const QString& file, DiagnosisChoice choice = {}) {
    DiagnosisPanel panel(runDiagnosis);
    choice.recordings = QStringList{file};
    panel.choose(choice);
    panel.diagnose();
    EXPECT_TRUE(QTest::qWaitFor([&] { return !panel.busy(); }, 200000));
    EXPECT_TRUE(panel.report()) << panel.summary().toStdString();
    return panel.report() ? diagnosis::jsonOf(*panel.report()) : nlohmann::json();
  }
  nlohmann::json commandLine(const QString& file, const QStringList& more = {}) {
    QProcess process;
    process.start(QString::fromStdString(capstan::test::commandLineProgram()),
                  QStringList{"diagnose", file, "--json", "-"} + more);
    EXPECT_TRUE(process.waitForFinished(200000));
    EXPECT_EQ(process.exitCode(), 0) << process.readAllStandardError().toStdString();
    return nlohmann::json::parse(process.readAllStandardOutput().toStdString());
  }

  QTemporaryDir folder_;
};

TEST_F(DiagnosisRuns, TheReportOfARecordingIsThatOfTheCommandLine) {
  testing::writeRecording(path("slow.csv"), {.duration = 3.0});
  const QString file = folder_.filePath("slow.csv");
  const nlohmann::json report = window(file);
  EXPECT_EQ(report.at("channels").size(), 3U);
  EXPECT_EQ(withoutTimes(report).dump(), withoutTimes(commandLine(file)).dump());
}

TEST_F(DiagnosisRuns, ToleranceUnitsAndEffortOfTheWindowAreThoseOfTheOptions) {
  const diagnosis::Evidence evidence = testing::sampleEvidence({.duration = 3.0}, 0);
  recording::MeasuredTable table;
  table.t = evidence.t, table.q_m = evidence.q_m, table.tau_m = evidence.tau_m, table.q = evidence.q;
  for (auto& column : table.q_m)
    for (double& q_m : column) q_m *= 180.0 / M_PI;
  base::writeTextFile(path("degrees.csv"), recording::formatMeasuredTable(table));
  const QString file = folder_.filePath("degrees.csv"), tolerance = "3deg,40mm";
  const nlohmann::json report = window(file, {.read_as = "q_m=deg", .material = tolerance, .effort = 0.01});
  EXPECT_EQ(report.at("material").at("length").get<double>(), 0.04);
  const QStringList options{"--material", tolerance, "--read-as", "q_m=deg", "--effort", "0.01"};
  EXPECT_EQ(withoutTimes(report).dump(), withoutTimes(commandLine(file, options)).dump());
}

TEST_F(DiagnosisRuns, OfATableOfTipPosesToo) {
  diagnosis::testing::PoseWorld late;
  late.trajectories = 40;
  late.offset = {2e-3, 0.0, -1e-3};
  base::writeTextFile(path("poses.csv"), poseTable(late));
  const QString file = folder_.filePath("poses.csv");
  const nlohmann::json report = withoutTimes(window(file)), all = commandLine(file);
  EXPECT_FALSE(report.at("causes").empty());
  for (const auto& [key, value] : report.items()) EXPECT_EQ(value.dump(), all.at(key).dump()) << key;
}

TEST_F(DiagnosisRuns, FilesThatDoNotGoTogetherAreRefusedAsOnTheCommandLine) {
  testing::writeRecording(path("slow.csv"), {.duration = 3.0});
  base::writeTextFile(path("poses.csv"), diagnosis::testing::poseTable({}));
  DiagnosisPanel panel(runDiagnosis);
  panel.choose({.recordings = {folder_.filePath("slow.csv"), folder_.filePath("poses.csv")}});
  panel.diagnose();
  ASSERT_TRUE(QTest::qWaitFor([&] { return !panel.busy(); }, 200000));
  EXPECT_FALSE(panel.report());
  EXPECT_THAT(panel.summary().toStdString(), HasSubstr("among other recordings"));
}

}  // namespace
}  // namespace capstan::widgets
