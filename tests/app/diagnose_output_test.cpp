// What people read of a diagnosis in a terminal.
#include "app/cli/diagnose_output.h"

#include <gtest/gtest.h>

#include <sstream>

#include "core/diagnosis/hypotheses/hypothesis.h"
#include "core/diagnosis/report/report_tables.h"
#include "tests/support/sample_diagnosis.h"

namespace capstan::cli {
namespace {

using diagnosis::Report;
using diagnosis::Verdict;
using testing::sampleReport;

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string flat(std::string text) {
  std::string out;
  for (const char c : text)
    if (c != '\n' && (c != ' ' || out.empty() || out.back() != ' '))
      out += c;
    else if (c == '\n' && !out.empty() && out.back() != ' ')
      out += ' ';
  return out;
}

TEST(DiagnoseText, BeginsWithTheVerdictThenCausesThenNumbers) {
  const Report report = sampleReport({.recordings = 2, .duration = 12.0});
  const std::string text = textOf(report), line = flat(text);
  EXPECT_EQ(flat(text).rfind(report.summary, 0), 0U) << text;
  const std::size_t cause = line.find("Backlash, joint 2: half width 0.930 ± 0.030 mm"),
                    gain = line.find("q2: RMS "), channels = line.find("model by model"),
                    refit = line.find("cable stiffness of joint 2"),
                    ranking = line.find("Ranking of the candidate effects"),
                    filter = line.find("Errors of the Kalman filter");
  for (const std::size_t at : {cause, gain, channels, refit, ranking, filter})
    ASSERT_NE(at, std::string::npos) << text;
  EXPECT_TRUE(cause < gain && gain < channels && channels < refit && refit < ranking && ranking < filter);
  EXPECT_TRUE(has(line, std::string(diagnosis::hypothesisNamed("backlash")->words.experiment)));
  EXPECT_TRUE(has(line, "probability 97 %"));
  EXPECT_TRUE(has(line, "verdict: found"));
}

TEST(DiagnoseText, SaysWhatACauseMovesAndWhatIsBelowTheTolerance) {
  Report report = sampleReport({.duration = 12.0});
  report.causes[0].moves.joints = {{}, {0.015, 0.033, false}, {0.0, 0.0, true}};
  diagnosis::Cause small = report.causes[0];
  small.effect = "asymmetric_friction", small.joint = 1, small.parameters = {{"share", "", 0.04, 0.01}};
  small.moves.joints = {{1e-4, 2e-4, false}, {}, {0.0, 0.0, true}};
  report.also_measurable = {small};
  report.material = {2e-3 * 3.14159265358979323846, 1e-4};
  const std::string line = flat(textOf(report));
  const std::size_t
      cause = line.find(diagnosis::causeText(report.causes[0])),
      moves = line.find(diagnosis::movesText(report.causes[0])),
      heading = line.find(
          "Also measurable, below the tolerance of 0.36deg,0.1mm or 6 % of the mean square of a channel:"),
      below = line.find(diagnosis::causeText(small) + "; " + diagnosis::movesText(small)),
      channels = line.find("model by model");
  for (const std::size_t at : {cause, moves, heading, below, channels})
    ASSERT_NE(at, std::string::npos) << line;
  EXPECT_TRUE(cause < moves && moves < heading && heading < below && below < channels);
  report.also_measurable.clear();
  EXPECT_FALSE(has(flat(textOf(report)), "Also measurable"));
}

TEST(DiagnoseText, ShowsRegressionsAndThePosteriorWhereThereIsAChoice) {
  Report report = sampleReport({.duration = 12.0});
  report.explainable = {{"q2", "rad", 1e-5, 0.02, 1e-3, 2e-3, 1.5e-3, 0.97, "depends on q_m2"}};
  report.posterior = {{{{"backlash", 2}}, 0.75}, {{{"cable_hysteresis", 2}}, 0.2}};
  const std::string text = flat(textOf(report));
  EXPECT_TRUE(has(text, diagnosis::explainableTable(report).title));
  EXPECT_TRUE(has(text, "depends on q_m2"));
  EXPECT_TRUE(has(text, diagnosis::posteriorTable(report).title));
  EXPECT_TRUE(has(text, "All other sets together: 5.0 %."));
  report.posterior.pop_back();
  EXPECT_FALSE(has(flat(textOf(report)), diagnosis::posteriorTable(report).title)) << "no choice";
}

TEST(DiagnoseText, TiesStandTogetherWithWhatWouldTellThemApart) {
  const Report report = sampleReport({.verdict = Verdict::kTie, .duration = 12.0});
  const std::string text = flat(textOf(report));
  EXPECT_TRUE(has(text, "cannot distinguish"));
  EXPECT_TRUE(has(text, "What would distinguish them: " + report.ties[0].separate));
  const std::size_t first = text.find(diagnosis::causeText(report.causes[0]));
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(text.find(diagnosis::causeText(report.causes[0]), first + 1), std::string::npos) << "once";
}

TEST(DiagnoseText, SaysWhatStaysUnexplained) {
  const Report report = sampleReport({.verdict = Verdict::kUnexplained});
  const std::string text = flat(textOf(report));
  EXPECT_TRUE(has(text, "The residual of q1 " + report.processes[0].words));
  EXPECT_TRUE(has(text, "7.30"));
  EXPECT_FALSE(has(text, "Kalman"));
  Report short_one = report;
  short_one.processes[0].end = diagnosis::ProcessEnd::kTooFew;
  EXPECT_FALSE(has(flat(textOf(short_one)), "The residual of q1"))
      << "a process that could not run says nothing";
}

TEST(DiagnoseText, TablesAreAlignedAndNoLineIsEndless) {
  base::Table table{
      "Title", {{"name", {}, 0, {}, false}, {"value", "mm", 2, {}, false}}, {{"µ", 1.0}, {"long", 10.0}}, {}};
  EXPECT_EQ(plainText(table), "Title\n  name  value [mm]\n  µ           1.00\n  long       10.00\n");
  table.rows[0].pop_back();
  EXPECT_TRUE(has(plainText(table), "–")) << "a cell that is missing is an empty one";
  std::istringstream lines(
      textOf(sampleReport({.verdict = Verdict::kSeveral, .recordings = 2, .duration = 12.0})));
  for (std::string line; std::getline(lines, line);) EXPECT_LT(line.size(), 160U) << line;
}

TEST(DiagnoseText, WrapsAtSpaces) {
  const std::string words = "one two three";
  EXPECT_EQ(wrapped(words, 2), "  one two three\n");
  EXPECT_EQ(wrapped(""), "");
  const std::string text = wrapped(std::string(60, 'a') + " " + std::string(60, 'b'), 1);
  EXPECT_EQ(text, " " + std::string(60, 'a') + "\n " + std::string(60, 'b') + "\n");
}

}  // namespace
}  // namespace capstan::cli
