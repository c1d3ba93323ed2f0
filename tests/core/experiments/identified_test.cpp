// Whose estimates an identification leaves, and the robot file that is written of them.
#include "core/experiments/identified.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "core/base/resource.h"

namespace capstan::experiments {
namespace {

using identification::BatchEnd;
using identification::BatchReport;
using identification::DualUkfEnd;
using identification::DualUkfReport;
using identification::Estimate;
using ::testing::HasSubstr;

Estimate known(double sigma) {
  Estimate estimate;
  estimate.parameter.nominal = 0.06;
  estimate.parameter.goal = 0.05;
  estimate.sigma = sigma;
  estimate.seen = true;
  return estimate;
}

DualUkfReport dualOf(DualUkfEnd end) {
  DualUkfReport report;
  report.end = end;
  report.estimates = {known(0.01)};
  return report;
}

BatchReport batchOf(BatchEnd end) {
  BatchReport report;
  report.end = end;
  report.estimates = {known(0.01)};
  return report;
}

TEST(Identified, TheMethodThatWasWantedIsTakenWhereItFoundSomething) {
  const DualUkfReport dual = dualOf(DualUkfEnd::kRecordingEnded);
  for (const BatchEnd end : {BatchEnd::kConverged, BatchEnd::kIterationLimit}) {
    const BatchReport batch = batchOf(end);
    EXPECT_EQ(choose(Method::kBatch, &dual, &batch).method, Method::kBatch);
    EXPECT_EQ(choose(Method::kDualUkf, &dual, &batch).method, Method::kDualUkf);
    EXPECT_TRUE(choose(Method::kBatch, &dual, &batch).words.empty());
  }
}

TEST(Identified, TheOtherMethodStandsInWithAWord) {
  const DualUkfReport dual = dualOf(DualUkfEnd::kSettled);
  for (const BatchEnd end : {BatchEnd::kFailed, BatchEnd::kNoData, BatchEnd::kCancelled}) {
    const BatchReport batch = batchOf(end);
    const Choice choice = choose(Method::kBatch, &dual, &batch);
    EXPECT_EQ(choice.method, Method::kDualUkf);
    EXPECT_EQ(choice.words, "the batch method found nothing (" + std::string(base::nameOf(end)) +
                                "): the result is that of the dual UKF");
  }
  BatchReport batch = batchOf(BatchEnd::kConverged);
  batch.estimates[0].log = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(choose(Method::kBatch, &dual, &batch).method, Method::kDualUkf);
  const DualUkfReport none = dualOf(DualUkfEnd::kNoData);
  batch = batchOf(BatchEnd::kConverged);
  EXPECT_EQ(choose(Method::kDualUkf, &none, &batch).method, Method::kBatch);
}

TEST(Identified, WhereNeitherFoundAnythingThereIsNone) {
  const DualUkfReport dual;  // without estimates, as from a recording without motion
  const BatchReport batch = batchOf(BatchEnd::kFailed);
  const Choice choice = choose(Method::kBatch, &dual, &batch);
  EXPECT_FALSE(choice.method);
  EXPECT_EQ(choice.words,
            "the batch method found nothing (failed), nor did the dual UKF (no camera observations)");
  EXPECT_FALSE(choose(Method::kBatch, nullptr, &batch).method);
  EXPECT_EQ(choose(Method::kBatch, nullptr, &batch).words, "the batch method found nothing (failed)");
  EXPECT_FALSE(foundSomething("failed"));
  EXPECT_FALSE(foundSomething("no camera observations"));
  EXPECT_TRUE(foundSomething("converged"));
  EXPECT_TRUE(foundSomething("recording ended"));
}

TEST(Identified, TimeThatIsNeededSaysUpToWhichSigma) {
  identification::Convergence convergence;
  convergence.time_needed = 772.4;
  EXPECT_EQ(progressWords(convergence, known(0.083)),
            "about 773 s more of this motion are needed (σ is 8.3 %, its goal 5 %)");
  convergence.settled = true;
  convergence.settled_at = 41.0;
  EXPECT_EQ(progressWords(convergence, known(0.01)), "settled after 41 s");
}

TEST(Identified, TheRobotFileSaysWhereItComesFromAndReadsBack) {
  const robot::Description nominal = robot::readDescription(base::resource("robots/raven2_left.yaml"));
  robot::Description found = nominal;
  found.drives[0].link_radius = 0.0590123456789;
  RobotOrigin origin;
  origin.recordings = {"a.capstan", "b\nname: x"};  // no line of its own
  origin.duration = 200.04;
  origin.method = "batch";
  origin.values = {valueLine("r_l1", 59.0123456, 0.011, "mm", true), valueLine("b_e1", 0, 0, "N·s/m", false)};
  origin.software = "capstan 1.2.3 (abcdef)";
  const std::string text = identifiedRobotText(nominal, found, origin);
  EXPECT_THAT(text,
              HasSubstr("# Identified from a.capstan, b name: x, 200.0 s, by the batch method of capstan "
                        "1.2.3 (abcdef); value ± one standard deviation:\n"
                        "#   r_l1 59.0123 ± 0.011 mm\n"
                        "#   b_e1 not observable, as before\n"));
  EXPECT_THAT(text, HasSubstr("0.0590123 instead of 0.063095"));
  EXPECT_EQ(robot::formatDescription(robot::parseDescription(text, "robot.yaml")),
            robot::formatDescription(found));
}

}  // namespace
}  // namespace capstan::experiments
