#include "core/live/streams/clock_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

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
  double worst_offset = 0.0, worst_drift = 0.0;
  for (unsigned seed = 0; seed < kDevices; ++seed) {
    Device device{12.5 + seed, 1e-6 * (static_cast<double>(seed) - 50.0), 0.02, std::mt19937(seed)};
    ClockMap clock;
    double stamp = 0.0;
    for (int k = 0; k < hertz * seconds; ++k) {
      stamp = k / hertz;
      EXPECT_FALSE(clock.add(stamp, device.arrival(stamp)));
    }
    const double true_offset = device.offset + device.drift * stamp;
    worst_offset = std::max(worst_offset, std::abs(clock.offset() - true_offset));
    worst_drift = std::max(worst_drift, std::abs(clock.drift() - device.drift));
    ASSERT_NEAR(clock.offset(), true_offset, 1e-3) << "device " << seed;
    ASSERT_NEAR(clock.drift(), device.drift, 5e-6) << "device " << seed;
    ASSERT_NEAR(clock.toSession(stamp), stamp + true_offset, 1e-3);
    ASSERT_NEAR(clock.meanDelay(), device.mean_delay, 0.25 * device.mean_delay);
    covered += std::abs(clock.offset() - true_offset) < 2.0 * clock.offsetUncertainty() &&
               std::abs(clock.drift() - device.drift) < 2.0 * clock.driftUncertainty();
    EXPECT_EQ(clock.steps(), 0);
  }
  std::printf(
      "%d devices, %.0f stamps/s for %.0f s, 20 ms of exponential jitter: largest errors offset %.3f ms, "
      "drift %.2f ppm; both within their stated 2 sigma: %d\n",
      kDevices, hertz, seconds, 1e3 * worst_offset, 1e6 * worst_drift, covered);
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
    std::printf("step of %+.1f s recognised after %.2f s\n", step, found - 15.0);
    EXPECT_GT(found, 15.0);
    EXPECT_LT(found, 16.0);
    EXPECT_EQ(clock.steps(), 1);
    EXPECT_NEAR(clock.offset(), device.offset - step, 2e-3);
  }
}

/// A camera whose images are held up: within a stall nothing arrives, and a burst follows. `busy`: from 10 s
/// on, stalls of 20 to 300 ms follow each other, and what comes between them is late by as much.
struct StalledCamera {
  double rate;
  bool lossy;  ///< a queue of four images drops the oldest ones
  std::mt19937 random;

  /// Pairs of stamp and arrival of `seconds`; `truth` of a time is the delay of a free camera.
  std::vector<std::pair<double, double>> pairs(double seconds, double busy_from, double busy_to) {
    std::vector<std::pair<double, double>> all, waiting;
    std::uniform_real_distribution<double> stall(0.02, 0.3), pause(0.0, 0.05);
    double free_at = busy_from;
    for (int k = 0; k < rate * seconds; ++k) {
      const double t = k / rate;
      if (t < busy_from || t >= busy_to) {
        const double at = t < busy_from ? t : std::max(t, free_at);
        flush(all, waiting, at);
        all.emplace_back(t, at + 0.001);
        continue;
      }
      while (t > free_at) {
        flush(all, waiting, free_at);
        free_at += stall(random) + pause(random);
      }
      waiting.emplace_back(t, 0.0);
      if (lossy && waiting.size() > 4) waiting.erase(waiting.begin());
    }
    return all;
  }
  static void flush(std::vector<std::pair<double, double>>& all,
                    std::vector<std::pair<double, double>>& waiting, double at) {
    for (const auto& [stamp, none] : waiting) all.emplace_back(stamp, std::max(stamp, at) + 0.001);
    waiting.clear();
  }
};

/// What is held up arrives late, but the stamps go on evenly: a stall is no step of the clock, whether it
/// comes before the first image, between free images or again and again.
TEST(ClockMap, TakesStallsAndBurstsForNoStep) {
  constexpr double kError = 1e-3 + 20.0 * ClockMap::kMostDrift;  // 20 s without a free image
  for (const double rate : {15.0, 30.0, 1000.0})
    for (const bool lossy : {false, true})
      for (const double begin : {0.0, 0.5, 10.0})
        for (unsigned seed = 0; seed < 20; ++seed) {
          StalledCamera camera{rate, lossy, std::mt19937(seed)};
          ClockMap clock;
          double last = 0.0;
          for (const auto& [stamp, arrival] : camera.pairs(40.0, begin, 30.0)) {
            ASSERT_FALSE(clock.add(stamp, arrival)) << stamp << " of seed " << seed;
            ASSERT_GE(arrival, last);
            last = arrival;
            if (begin == 0.0) continue;  // no free image has been seen yet
            ASSERT_NEAR(clock.toSession(stamp), stamp + 0.001, kError) << stamp << " of seed " << seed;
          }
          EXPECT_EQ(clock.steps(), 0);
          EXPECT_NEAR(clock.offset(), 0.001, 2e-3);
        }
}

/// A machine that is too slow for a time: everything is late by 0.2 s, for longer than a step has to be seen.
TEST(ClockMap, TakesABacklogThatLastsForNoStep) {
  ClockMap clock;
  for (int k = 0; k < 1200; ++k) {
    const double stamp = k / 30.0;
    const bool late = stamp > 10.0 && stamp < 25.0;
    ASSERT_FALSE(clock.add(stamp, stamp + (late ? 0.2 : 0.001))) << stamp;
    ASSERT_NEAR(clock.toSession(stamp), stamp + 0.001, 8e-3) << stamp;
  }
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_NEAR(clock.offset(), 0.001, 1e-3);
}

/// The first images waited for 0.3 s: the line begins too high, and comes down without a step.
TEST(ClockMap, ComesDownFromABacklogAtTheBegin) {
  ClockMap clock;
  for (int k = 0; k < 300; ++k) {
    const double stamp = k / 30.0;
    ASSERT_FALSE(clock.add(stamp, stamp < 5.0 ? stamp + 0.3 : std::max(stamp, 5.3) + 0.001));
  }
  EXPECT_EQ(clock.steps(), 0);
  EXPECT_NEAR(clock.offset(), 0.001, 1e-3);
}

TEST(ClockMap, RecognisesAStepAmongStalls) {
  for (const double step : {0.5, -0.5})
    for (const bool lossy : {false, true})
      for (unsigned seed = 0; seed < 50; ++seed) {
        StalledCamera camera{30.0, lossy, std::mt19937(seed)};
        ClockMap clock;
        double found = -1.0;
        for (const auto& [t, arrival] : camera.pairs(60.0, 10.0, 30.0))
          if (clock.add(t + (t > 20.0 ? step : 0.0), arrival)) found = t;
        EXPECT_GT(found, 20.0) << step << " of seed " << seed;
        EXPECT_LT(found, 21.0) << step << " of seed " << seed;
        EXPECT_EQ(clock.steps(), 1) << step << " of seed " << seed;
        EXPECT_NEAR(clock.offset(), 0.001 - step, 2e-3) << step << " of seed " << seed;
      }
}

/// Two cameras of one clock, one of them held up: its stamps come after newer ones of the other.
TEST(ClockMap, StreamsOfOneClockMayBeLateByThemselves) {
  ClockMap clock;
  for (int k = 0; k < 900; ++k) {
    const double stamp = k / 30.0;
    ASSERT_FALSE(clock.add(stamp, stamp + 0.001, 0));
    const double held = stamp - 0.3;  // arrives with the newest of the other
    if (held < 0.0) continue;
    ASSERT_FALSE(clock.add(held, stamp + 0.001, 1));
    ASSERT_NEAR(clock.toSession(stamp), stamp + 0.001, 1e-9);
  }
  EXPECT_EQ(clock.steps(), 0);
}

TEST(ClockMap, OneWrongStampIsNoStep) {
  for (const double wrong : {7.0, -7.0}) {
    ClockMap clock;
    for (int k = 0; k < 600; ++k) {
      const double stamp = k / 30.0;
      EXPECT_FALSE(clock.add(k == 300 ? stamp + wrong : stamp, stamp + 0.001));
    }
    EXPECT_NEAR(clock.offset(), 0.001, 1e-9);
    EXPECT_EQ(clock.steps(), 0);
  }
}

/// A clock at half the rate is none that drifts; its stamps are followed all the same.
TEST(ClockMap, FollowsAClockOfAnotherRate) {
  ClockMap clock;
  for (int k = 0; k < 3000; ++k) {
    const double stamp = k / 100.0;
    clock.add(stamp, 2.0 * stamp);
    ASSERT_NEAR(clock.toSession(stamp), 2.0 * stamp, 2.2) << stamp;
  }
  EXPECT_EQ(clock.steps(), 0);
}

TEST(ClockMap, BeginsAgainWhereTheClockIsKnownToHaveChanged) {
  ClockMap clock;
  for (int k = 0; k < 300; ++k) clock.add(k / 30.0, k / 30.0 + 0.001);
  clock.forget();
  EXPECT_FALSE(clock.add(3.0, 10.2));
  EXPECT_NEAR(clock.toSession(3.1), 10.3, 1e-12);
  EXPECT_EQ(clock.steps(), 0);
}

}  // namespace
}  // namespace capstan::live
