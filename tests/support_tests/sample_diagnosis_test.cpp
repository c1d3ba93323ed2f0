// The sample report that screens and pages are tested with hangs together as a real one does.
#include "tests/support/sample_diagnosis.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace capstan::testing {
namespace {

using diagnosis::ChannelReport;
using diagnosis::Report;
using diagnosis::Verdict;

const ChannelReport& channelOf(const Report& report, const std::string& name) {
  return *std::find_if(report.channels.begin(), report.channels.end(),
                       [&](const ChannelReport& channel) { return channel.refitted.name == name; });
}

TEST(SampleDiagnosis, ShowsBacklashAgainstTheDirectionUntilItIsInTheModel) {
  const Report report = sampleReport();
  ASSERT_EQ(report.channels.size(), 3U);
  const ChannelReport& q2 = channelOf(report, "q2");
  EXPECT_TRUE(q2.before[0].variable == "direction of joint 2" ||
              q2.before[0].variable == "velocity of joint 2")
      << q2.before[0].variable;
  EXPECT_GT(q2.before[0].share, 0.7);
  EXPECT_LT(q2.after[0].share, 0.4);
  EXPECT_LT(q2.extended_statistics.rms, 0.3 * q2.refitted_statistics.rms);
  EXPECT_LT(q2.refitted_statistics.rms, q2.nominal_statistics.rms);
}

TEST(SampleDiagnosis, HasEveryVerdictSeveralRecordingsAndCameras) {
  for (const auto& [verdict, name] : base::NamesOf<Verdict>::value) {
    const Report report = sampleReport({.verdict = verdict, .recordings = 2, .duration = 12.0});
    EXPECT_EQ(report.verdict, verdict);
    EXPECT_EQ(report.channels.size(), 6U) << name;
    EXPECT_EQ(report.recordings.size(), 2U);
    EXPECT_EQ(report.causes.empty(), verdict == Verdict::kNothing || verdict == Verdict::kUnexplained);
    EXPECT_EQ(report.ties.empty(), verdict != Verdict::kTie);
    EXPECT_EQ(report.also_measurable.empty(), report.causes.empty());
    EXPECT_EQ(report.explainable.size(), 3U) << "one a joint, of both recordings";
    double probability = 0.0;
    for (const auto& set : report.posterior) probability += set.probability;
    EXPECT_GT(probability, 0.9) << name;
    EXPECT_LE(probability, 1.0) << name;
    EXPECT_EQ(report.lines.empty(), verdict != Verdict::kUnexplained);
  }
  const Report observed = sampleReport({.cameras = true, .duration = 12.0});
  EXPECT_EQ(observed.channels.size(), 6U);
  EXPECT_EQ(observed.channels.back().refitted.name, "tip z");
}

TEST(SampleDiagnosis, UnexplainedHasAProcessThatGoesWithThePosition) {
  const Report report = sampleReport({.verdict = Verdict::kUnexplained});
  ASSERT_EQ(report.processes.size(), 1U);
  EXPECT_EQ(report.processes[0].channel, "q1");
  ASSERT_FALSE(report.processes[0].variables.empty());
  EXPECT_NE(report.processes[0].words.find("joint 1"), std::string::npos) << report.processes[0].words;
}

TEST(SampleDiagnosis, IsTheSameEveryTime) {
  EXPECT_EQ(sampleReport().channels[0].refitted.residual, sampleReport().channels[0].refitted.residual);
  EXPECT_EQ(sampleEvidence().q, sampleEvidence().q);
}

}  // namespace
}  // namespace capstan::testing
