#include "core/live/streams/clock_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::live {
namespace {

/// A device whose clock is `offset` behind the session's and `drift` slower, seen through exponential delays.
struct Device {
  double offset, drift, mean_delay;
  std::mt19937 random;

  double arrival(double stamp) {
    return stamp * (1.0 + drift) + offset + std::exponential_distribution<double>(1.0 / mean_delay)(random);
  }
};

struct Rate {
  double hertz, seconds;
};
class ClockMapAtRate : public ::testing::TestWithParam<Rate> {};

/// Offset within 1 ms and drift within 5 ppm under 20 ms of jitter, with a stated uncertainty that holds.
TEST_P(ClockMapAtRate, FindsOffsetAndDrift) {
  const auto [hertz, seconds] = GetParam();
  constexpr int kDevices = 100;
  int covered = 0;
  for (unsigned seed = 0; seed < kDevices; ++seed) {
    Device device{12.5 + seed, 1e-6 * (static_cast<double>(seed) - 50.0), 0.02, std::mt19937(seed)};
    ClockMap clock;
    double stamp = 0.0;
    for (int k = 0; k < hertz * seconds; ++k) {
      stamp = k / hertz;
      EXPECT_FALSE(clock.add(stamp, device.arrival(stamp)));
    }
    const double true_offset = device.offset + device.drift * stamp;
    ASSERT_NEAR(clock.offset(), true_offset, 1e-3) << "device " << seed;
    ASSERT_NEAR(clock.drift(), device.drift, 5e-6) << "device " << seed;
    ASSERT_NEAR(clock.toSession(stamp), stamp + true_offset, 1e-3);
    ASSERT_NEAR(clock.meanDelay(), device.mean_delay, 0.25 * device.mean_delay);
    covered += std::abs(clock.offset() - true_offset) < 2.0 * clock.offsetUncertainty() &&
               std::abs(clock.drift() - device.drift) < 2.0 * clock.driftUncertainty();
    EXPECT_EQ(clock.steps(), 0);
  }
  EXPECT_GE(covered, 85) << "of " << kDevices << " within two standard deviations";
}
INSTANTIATE_TEST_SUITE_P(Streams, ClockMapAtRate, ::testing::Values(Rate{30.0, 120.0}, Rate{1000.0, 30.0}));

TEST(ClockMap, RecognisesASteppedClock) {
  for (const double step : {0.5, -0.5}) {
    Device device{3.0, 0.0, 0.02, std::mt19937(7)};
    ClockMap clock;
    double found = -1.0;
    for (int k = 0; k < 3000; ++k) {
      const double true_time = k / 100.0, stepped = true_time > 15.0 ? step : 0.0;
      if (clock.add(true_time + stepped, device.arrival(true_time))) found = true_time;
    }
    EXPECT_GT(found, 15.0);
    EXPECT_LT(found, 16.0);
    EXPECT_EQ(clock.steps(), 1);
    EXPECT_NEAR(clock.offset(), device.offset - step, 2e-3);
  }
}

/// What is held up arrives late, but the last of it without a delay.
TEST(ClockMap, TakesAStallForNoStep) {
  ClockMap clock;
  for (int k = 0; k < 3000; ++k) {
    const double stamp = k / 100.0;
    const bool stalled = stamp > 10.0 && stamp < 10.4;
    EXPECT_FALSE(clock.add(stamp, stalled ? 10.4 : stamp + 0.001));
  }
  EXPECT_EQ(clock.steps(), 0);
}

}  // namespace
}  // namespace capstan::live
