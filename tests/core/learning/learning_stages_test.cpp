// From a table whose flaws are known to states: every flaw is found where it was put.
#include "core/learning/evaluation/learning_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/recording/pose_table.h"
#include "tests/support/sample_poses.h"

namespace capstan::learning {
namespace {

using learning::Reason;
using learning::StreamKind;
using testing::SamplePoses;

LearningStages stagesOf(const SamplePoses& sample, StreamKind towards = StreamKind::kCommand) {
  LearningOptions options;
  options.towards = towards;
  options.cleaning = {};
  return learningStages(recording::parsePoseTable(testing::samplePoseTable(sample), "poses.csv"), options);
}

TEST(LearningStages, FindEveryFlawWhereItWasPut) {
  const SamplePoses sample;
  const LearningStages stages = stagesOf(sample);
  EXPECT_EQ(stages.screen.count(StreamKind::kCamera, Reason::kPlaceholder), 20U);
  EXPECT_EQ(stages.screen.rejected.size(), 20U);
  EXPECT_NEAR(stages.clock_offset.clock_offset, sample.clock_offset, 2.0 * stages.clock_offset.sigma);
  EXPECT_LT(stages.clock_offset.sigma, 5e-3) << "half a sample";
  ASSERT_EQ(stages.motions.size(), 20U);
  EXPECT_EQ(stages.states.size() + stages.unpaired, 20U * 59U);
  for (std::size_t m = 0; m + 1 < stages.motions.size(); ++m) {
    EXPECT_GE(stages.motions[m].rejected, 2U) << "two rows jump";
    EXPECT_LE(stages.motions[m].rejected, 14U) << "and those beside them seem fast";
  }
  EXPECT_EQ(stages.motions.back().rejected, stages.motions.back().states()) << "all of it jumps";
  EXPECT_LT((stages.offset.translation() - testing::sampleOffset().translation()).norm(), 6e-3);
  EXPECT_GT(stages.before.median_distance, 0.1);
  EXPECT_LT(stages.after.median_distance, 5e-3);
  EXPECT_GT(stages.speed.high, stages.speed.median);
}

TEST(LearningStages, ListEveryRowAndStateThatWasLeftOut) {
  const LearningStages stages = stagesOf({});
  const std::string csv = rejectedCsv(stages);
  const auto lines = static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n'));
  EXPECT_EQ(lines, 1 + stages.screen.rejected.size() + stages.states.size() - stages.cleaning.kept());
  EXPECT_THAT(csv, ::testing::HasSubstr("\"task 0, trajectory 0\",camera,42,placeholder\n"));
}

TEST(LearningStages, AStreamThatIsNotThereIsNamed) {
  SamplePoses sample;
  sample.command = false;
  EXPECT_GT(stagesOf(sample, StreamKind::kRobot).cleaning.kept(), 900U);
  try {
    stagesOf(sample);
    FAIL() << "there are no commands";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("command: these tables have no such poses"));
  }
}

TEST(LearningStages, StopWhenCancelled) {
  base::Progress progress;
  progress.cancel();
  const auto motions = recording::parsePoseTable(testing::samplePoseTable(), "poses.csv");
  EXPECT_TRUE(learningStages(motions, {}, &progress).cancelled);
}

}  // namespace
}  // namespace capstan::learning
