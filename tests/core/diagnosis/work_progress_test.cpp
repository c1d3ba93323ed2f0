// Progress of work whose end is not known.
#include "core/diagnosis/selection/work_progress.h"

#include <gtest/gtest.h>

#include "core/base/progress_share.h"

namespace capstan::diagnosis {
namespace {

TEST(WorkProgress, IsLinearWhereTheExpectationHolds) {
  WorkProgress progress;
  progress.expect(10.0);
  for (int done = 1; done <= 8; ++done) EXPECT_NEAR(progress.advance(done), 0.1 * done, 1e-12) << done;
}

TEST(WorkProgress, NeverStandsAndNeverReachesTheEnd) {
  WorkProgress progress;
  progress.expect(10.0);
  double last = 0.0;
  for (int done = 1; done <= 40; ++done) {
    const double now = progress.advance(done);
    EXPECT_GT(now, last) << done;
    EXPECT_LT(now, 1.0) << done;
    last = now;
  }
  EXPECT_EQ(progress.advance(40.0), last) << "no work, no progress";
}

TEST(WorkProgress, GoesOnMoreSlowlyWhereMoreIsExpected) {
  WorkProgress progress;
  progress.expect(10.0);
  const double half = progress.advance(5.0);
  EXPECT_NEAR(half, 0.5, 1e-12);
  progress.expect(10.0);  // twice what was left
  EXPECT_NEAR(progress.advance(6.0), 0.55, 1e-12);
  EXPECT_NEAR(progress.advance(7.0), 0.60, 1e-12);
}

TEST(WorkProgress, APieceThatIsLargerThanAllThatWasExpectedLeavesARest) {
  WorkProgress progress;
  progress.expect(1.0);
  EXPECT_LT(progress.advance(100.0), 0.9);
}

TEST(ProgressShare, GoesOnFromThePresentFraction) {
  base::Progress progress;
  progress.report(0.8, "before");
  base::ProgressShare share(&progress, 0.9, "filtering", 4);
  EXPECT_EQ(progress.fraction(), 0.8);
  EXPECT_EQ(progress.doing(), "filtering");
  share.finished();
  EXPECT_NEAR(progress.fraction(), 0.825, 1e-12);
  for (int piece = 0; piece < 3; ++piece) share.finished();
  EXPECT_NEAR(progress.fraction(), 0.9, 1e-12);
  base::ProgressShare back(&progress, 0.1, "never back", 1);
  back.finished();
  EXPECT_NEAR(progress.fraction(), 0.9, 1e-12);
  base::ProgressShare(nullptr, 1.0, "nobody watches", 1).finished();
}

}  // namespace
}  // namespace capstan::diagnosis
