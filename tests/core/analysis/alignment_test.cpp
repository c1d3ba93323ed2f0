#include "core/analysis/alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"

namespace capstan::analysis {
namespace {

using Eigen::Vector3d;

/// A smooth motion that never repeats, at time t [s].
Vector3d motion(double t) {
  return {0.3 * std::sin(0.7 * t) + 0.2 * std::sin(1.93 * t),
          0.4 * std::cos(0.51 * t) - 0.1 * std::sin(2.7 * t), 0.03 * std::sin(0.37 * t + 0.02 * t * t)};
}

/// The motion from `from` to `to`, as a session whose clock is `clock` ahead sees it, at `rate` [1/s].
MotionSeries seen(double from, double to, double clock, double rate, double noise = 0.0,
                  std::uint64_t seed = 1) {
  base::Random random(seed);
  MotionSeries series;
  for (double t = from; t < to; t += 1.0 / rate) {
    Vector3d q = motion(t);
    for (int joint = 0; joint < 3; ++joint) q(joint) += random.normal(0.0, noise * (joint == 2 ? 0.05 : 1.0));
    series.add(t + clock, q);
  }
  return series;
}

TEST(MotionSeriesTest, InterpolatesAndBridgesGaps) {
  MotionSeries series;
  for (const double t : {1.0, 1.03, 1.05, 3.0}) series.add(t, Vector3d(t, 2.0 * t, 0.0));
  EXPECT_EQ(series.begin(), 1.0);
  EXPECT_NEAR(series.positions()[1](0), 1.02, 1e-12);
  EXPECT_NEAR(series.positions()[2](1), 2.08, 1e-12);
  EXPECT_NEAR(series.positions()[50](0), 1.05, 1e-12) << "nothing is known of the gap";
  EXPECT_NEAR(series.end(), 3.0, 0.03);
  series.add(2.0, Vector3d::Zero());  // back in time
  EXPECT_NEAR(series.end(), 3.0, 0.03);
}

TEST(AlignmentTest, FindsTheOffsetToAFractionOfAStep) {
  for (const double clock : {0.0, 3.137, -17.4912, 100000.0031}) {
    const auto found = alignmentOf(seen(0.0, 60.0, 0.0, 1000.0), seen(5.0, 50.0, clock, 177.0, 1e-4));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->offset, clock, 2e-3) << clock;
    EXPECT_GT(found->correlation, 0.95);
    EXPECT_NEAR(found->overlap, 45.0, 0.1);
    EXPECT_TRUE(found->clear()) << found->second_best;
  }
}

TEST(AlignmentTest, TakesPartsThatOverlapByHalf) {
  const auto found = alignmentOf(seen(0.0, 40.0, 0.0, 200.0), seen(20.0, 60.0, 7.0, 200.0));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->offset, 7.0, 2e-3);
  EXPECT_NEAR(found->overlap, 20.0, 0.1);
}

TEST(AlignmentTest, SaysThatMotionsDifferOrRepeat) {
  MotionSeries other, again;
  for (double t = 0.0; t < 60.0; t += 0.01) {
    other.add(t, Vector3d(std::sin(1.3 * t * (1.0 + 0.01 * t)), std::cos(0.9 * t), 0.02 * std::sin(3.0 * t)));
    again.add(t, Vector3d(std::sin(2.0 * t), std::cos(2.0 * t), 0.0));
  }
  const auto apart = alignmentOf(seen(0.0, 60.0, 0.0, 200.0), other);
  ASSERT_TRUE(apart);
  EXPECT_FALSE(apart->same()) << apart->correlation;
  const auto repeats = alignmentOf(again, again);
  ASSERT_TRUE(repeats);
  EXPECT_TRUE(repeats->same());
  EXPECT_FALSE(repeats->clear()) << repeats->second_best;
}

TEST(AlignmentTest, NothingIsSaidOfRestOrOfAnInstant) {
  MotionSeries rest;
  for (double t = 0.0; t < 10.0; t += 0.01) rest.add(t, Vector3d::Ones());
  EXPECT_FALSE(alignmentOf(rest, rest));
  EXPECT_FALSE(alignmentOf(seen(0.0, 60.0, 0.0, 200.0), seen(0.0, 1.0, 0.0, 200.0)));
  EXPECT_FALSE(alignmentOf({}, {}));
}

}  // namespace
}  // namespace capstan::analysis
