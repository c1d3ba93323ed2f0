// Progress of work whose end is not known.
#include "core/diagnosis/selection/work_progress.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/progress_share.h"

namespace capstan::diagnosis {
namespace {

TEST(WorkProgress, BeginsEvenlyByTheExpectation) {
  WorkProgress progress;
  progress.expect(30.0);
  for (int done = 1; done <= 10; ++done) EXPECT_NEAR(progress.advance(done), done / 30.0, 1e-12) << done;
}

TEST(WorkProgress, NeverStandsAndNeverReachesTheEnd) {
  WorkProgress progress;
  progress.expect(10.0);
  double last = 0.0;
  for (int done = 1; done <= 200; ++done) {
    const double now = progress.advance(done);
    EXPECT_GT(now, last) << done;
    EXPECT_LT(now, 1.0) << done;
    last = now;
  }
  EXPECT_EQ(progress.advance(200.0), last) << "no work, no progress";
}

/// Beyond the expectation twice the work done may be left: dr/r = -dw / (2 w), so that a doubling of the work
/// leaves 1/√2 of the remainder.
TEST(WorkProgress, KeepsRoomForMoreThanIsExpected) {
  WorkProgress progress;
  progress.expect(10.0);
  double before = 0.0;
  for (int k = 1; k <= 16000; ++k) {
    const double left = 1.0 - progress.advance(0.01 * k);
    if (k == 2000) before = left;
    if (k != 4000 && k != 8000 && k != 16000) continue;
    EXPECT_NEAR(left / before, std::sqrt(0.5), 1e-3) << k;
    before = left;
  }
}

TEST(WorkProgress, IsEvenTowardsItsLimit) {
  WorkProgress progress(100.0);
  progress.expect(10.0);
  double at_80 = 0.0, at_90 = 0.0, at_98 = 0.0;
  for (int done = 1; done <= 98; ++done) {
    const double now = progress.advance(done);
    if (done == 80) at_80 = now;
    if (done == 90) at_90 = now;
    if (done == 98) at_98 = now;
  }
  EXPECT_NEAR((at_90 - at_80) / 10.0, (at_98 - at_90) / 8.0, 1e-9);
  EXPECT_GT(at_98, 0.95);
  EXPECT_LT(progress.advance(130.0), 1.0) << "what was begun is finished";
}

TEST(WorkProgress, GoesOnMoreSlowlyWhereMoreIsExpected) {
  WorkProgress progress;
  progress.expect(30.0);
  EXPECT_NEAR(progress.advance(5.0), 1.0 / 6.0, 1e-12);
  progress.expect(50.0);  // twice what was left
  EXPECT_NEAR(progress.advance(6.0), 1.0 / 6.0 + 5.0 / 6.0 / 50.0, 1e-12);
}

TEST(WorkProgress, APieceThatIsLargerThanAllThatWasExpectedLeavesARest) {
  WorkProgress progress;
  progress.expect(1.0);
  EXPECT_LT(progress.advance(100.0), 0.4);
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
