#include "widgets/figures/diagnosis_export.h"

#include <gtest/gtest.h>

#include <QTemporaryDir>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "core/base/error.h"
#include "core/base/yaml.h"
#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/report/report_tables.h"
#include "tests/support/sample_diagnosis.h"

/// The page of a diagnosis says what its report says, and leads nowhere but to its own files.
namespace capstan::widgets {
namespace {

namespace fs = std::filesystem;
using diagnosis::Report;
using diagnosis::Verdict;
using testing::sampleReport;

class DiagnosisPages : public ::testing::Test {
 protected:
  fs::path at(const std::string& name) const { return fs::path(folder_.path().toStdString()) / name; }
  /// Kept in CAPSTAN_PICTURES, where that is set.
  fs::path pageFolder(const std::string& name) const {
    const QString kept = qEnvironmentVariable("CAPSTAN_PICTURES");
    return kept.isEmpty() ? at(name) : fs::path(kept.toStdString()) / ("diagnosis_" + name);
  }
  std::string page(const Report& report, const std::string& name = "out") {
    exportDiagnosis(report, {"RAVEN-II left", "capstan 9", "2026-01-02T03:04:05"}, pageFolder(name));
    return base::readTextFile(pageFolder(name) / "index.html");
  }
  static bool has(const std::string& html, const std::string& text) {
    return html.find(text) != std::string::npos;
  }

  QTemporaryDir folder_;
};

TEST_F(DiagnosisPages, EveryLinkLeadsToAFileAndEveryFileIsLinked) {
  const Report report = sampleReport({.verdict = Verdict::kSeveral, .recordings = 2, .duration = 12.0});
  const auto files = exportDiagnosis(report, {"R", "capstan 9", {}}, at("out"));
  EXPECT_EQ(files.back(), at("out") / "index.html");
  const std::string html = base::readTextFile(at("out") / "index.html");
  EXPECT_TRUE(has(html, kDiagnosisMark));
  EXPECT_FALSE(has(html, "<script"));
  EXPECT_FALSE(has(html, "http")) << "opens without a network";
  std::set<std::string> linked;
  const std::regex link("(?:href|src)=\"([^\"]*)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), link), end; it != end; ++it) linked.insert((*it)[1]);
  for (const std::string& name : linked) EXPECT_TRUE(fs::exists(at("out") / name)) << name;
  for (const fs::path& file : files)
    EXPECT_TRUE(file.filename() == "index.html" || linked.count(file.filename().string()) == 1) << file;
  EXPECT_TRUE(linked.count("q2-residual.svg") == 1 && linked.count("q1-signatures.pdf") == 1);
  EXPECT_LT(html.find("q2-residual.svg"), html.find("q1-residual.svg")) << "the first cause's channel first";
}

TEST_F(DiagnosisPages, SayTheVerdictTheCausesAndWhatIsToldOfThem) {
  const Report report = sampleReport({.cameras = true});
  const std::string html = page(report, "found");
  EXPECT_TRUE(has(html, "One cause found"));
  EXPECT_TRUE(has(html, report.summary));
  EXPECT_TRUE(has(html, "half width 0.930 ± 0.030 mm"));
  const auto& words = diagnosis::hypothesisNamed("backlash")->words;
  for (const std::string_view part : {words.title, words.what, words.experiment, words.source})
    EXPECT_TRUE(has(html, std::string(part))) << part;
  EXPECT_TRUE(has(html, "Worth</dt><dd>q2: RMS"));
  EXPECT_TRUE(has(html, "Displacement</dt><dd>" + diagnosis::movesText(report.causes[0])));
  EXPECT_TRUE(has(html,
                  "<summary>Also measurable, below the tolerance of 0.02deg,0.02mm or 6 % of the mean square "
                  "of a channel</summary>"));
  EXPECT_TRUE(has(html, diagnosis::causeText(report.also_measurable[0])));
  EXPECT_TRUE(has(html, diagnosis::posteriorTable(report).title));
  EXPECT_TRUE(has(html, "--share:87%")) << "a bar behind the posterior";
  EXPECT_TRUE(has(html, diagnosis::explainableTable(report).title));
  EXPECT_TRUE(has(html, "without effects"));
  EXPECT_TRUE(has(html, "cable stiffness of joint 2"));
  EXPECT_TRUE(has(html, "Errors of the Kalman filter with each model"));
  EXPECT_TRUE(has(html, "--share:97%")) << "a bar behind the probability";
  EXPECT_TRUE(has(html, report.notices[0]));
}

TEST_F(DiagnosisPages, SayWhatWouldTellATieApart) {
  const Report report = sampleReport({.verdict = Verdict::kTie});
  const std::string html = page(report, "tie");
  EXPECT_TRUE(has(html, "cannot decide"));
  EXPECT_TRUE(has(html, report.ties[0].separate));
  EXPECT_TRUE(has(html, diagnosis::titleOf("cable_hysteresis") + ", joint 2"));
  std::size_t cards = 0;
  for (std::size_t i = 0; (i = html.find("<section class=\"cause\">", i)) != std::string::npos; ++i) ++cards;
  EXPECT_EQ(cards, 2U) << "each of the tie once";
}

TEST_F(DiagnosisPages, SayWhatStaysUnexplainedAndThatNothingIsWorthNaming) {
  const Report report = sampleReport({.verdict = Verdict::kUnexplained});
  const std::string html = page(report, "unexplained");
  EXPECT_TRUE(has(html, "no hypothesis explains"));
  EXPECT_TRUE(has(html, "7.30")) << "the line [Hz]";
  EXPECT_TRUE(has(html, report.processes[0].words));
  const std::string quiet = page(sampleReport({.verdict = Verdict::kNothing}), "nothing");
  EXPECT_TRUE(has(quiet, "Nothing material"));
  EXPECT_FALSE(has(quiet, "Causes</h2>"));
  EXPECT_FALSE(has(quiet, "extended"));
  EXPECT_FALSE(has(quiet, "Also measurable"));
}

TEST_F(DiagnosisPages, EscapeWhatComesFromFiles) {
  Report report = sampleReport({.duration = 12.0});
  report.recordings = {"<b>&.csv"};
  report.notices = {"a < b"};
  const std::string html = page(report, "escaped");
  EXPECT_FALSE(has(html, "<b>&.csv"));
  EXPECT_TRUE(has(html, "&lt;b&gt;&amp;.csv"));
  EXPECT_TRUE(has(html, "a &lt; b"));
}

TEST_F(DiagnosisPages, RobotAndJsonLieBeside) {
  const Report report = sampleReport({.duration = 12.0});
  page(report, "beside");
  const fs::path folder = pageFolder("beside");
  EXPECT_EQ(robot::formatDescription(robot::readDescription(folder / "robot.yaml")),
            robot::formatDescription(report.extended));
  EXPECT_EQ(nlohmann::json::parse(base::readTextFile(folder / "report.json")).at("verdict"), "found");
}

TEST_F(DiagnosisPages, AFormerOneIsWrittenOverAndNothingElse) {
  const Report report = sampleReport({.duration = 12.0});
  exportDiagnosis(report, {}, at("out"));
  EXPECT_NO_THROW(exportDiagnosis(report, {}, at("out")));
  fs::create_directories(at("mine"));
  base::writeTextFile(at("mine") / "notes.txt", "mine");
  try {
    exportDiagnosis(report, {}, at("mine"));
    FAIL() << "wrote into a folder of somebody else's";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("former report"), std::string::npos) << error.what();
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(at("mine")), {}), 1);
}

TEST_F(DiagnosisPages, CancelledStopsDrawingButLeavesAPage) {
  base::Progress progress;
  progress.cancel();
  exportDiagnosis(sampleReport({.duration = 12.0}), {}, at("out"), &progress);
  const std::string html = base::readTextFile(at("out") / "index.html");
  EXPECT_TRUE(has(html, "q2-residual.svg"));
  EXPECT_FALSE(has(html, "q3-residual.svg"));
  EXPECT_TRUE(fs::exists(at("out") / "report.json"));
}

TEST_F(DiagnosisPages, AReportWithoutChannelsIsAPage) {
  Report report;
  report.summary = "Cancelled before anything was known.";
  report.cancelled = true;
  report.extended = sampleReport({.duration = 12.0}).extended;
  const std::string html = page(report, "empty");
  EXPECT_TRUE(has(html, "no verdict"));
  EXPECT_FALSE(has(html, verdictText(report.verdict))) << "half of the work says nothing";
}

}  // namespace
}  // namespace capstan::widgets
