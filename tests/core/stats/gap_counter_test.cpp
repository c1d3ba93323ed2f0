#include "core/stats/gap_counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace capstan::stats {
namespace {

TEST(GapCounter, CountsWhatIsMissingInASteadyStream) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-5e-5, 5e-5);
  GapCounter gaps;
  std::uint64_t withheld = 0;
  for (int k = 0; k < 5000; ++k) {
    const bool counted = k > 100;  // the period is known
    if (counted && (k % 50 == 0 || (k % 500) / 3 == 60)) {
      ++withheld;
      continue;
    }
    gaps.add(1e-3 * k + jitter(random) + (k > 3010 ? 2.0 : 0.0));  // and one silence of 2 s
  }
  EXPECT_EQ(gaps.missing(), withheld);
  EXPECT_EQ(gaps.silences(), 1U);
  EXPECT_NEAR(gaps.lastSilence(), 2.0, 0.005);
}

/// A recording that is played again, or a clock that is set.
TEST(GapCounter, AClockThatStepsBackTakesNothingBack) {
  GapCounter gaps;
  for (int k = 0; k < 500; ++k)
    if (k != 400 && (k < 490 || k >= 495)) gaps.add(1e-3 * k);
  EXPECT_EQ(gaps.missing(), 1U) << "the newest samples hide the other gap";
  for (int k = 0; k < 500; ++k)
    if (k < 100 || k >= 103) gaps.add(1e-3 * k - 7.0);
  EXPECT_EQ(gaps.missing(), 9U);
}

/// Stamps of a steady sender that is held up for up to `most` periods, twenty times a second, and that is
/// interrupted again while it makes up for them.
std::uint64_t missingOf(int most, bool own_even_stamps, int lost_rows) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> some(1, most);
  GapCounter gaps;
  double busy_until = 0.0;
  for (int k = 0; k < 5000; ++k) {
    const double due = 1e-3 * k;
    if (k > 100 && k % 50 == 0) busy_until = std::max(busy_until, due + 1e-3 * some(random) + 0.4e-3);
    if (k > 100 && k % 50 < lost_rows) continue;
    const double sent = std::max(due, busy_until);
    busy_until = sent + (k % 7 == 0 && sent > due ? 1.1e-3 : 2e-5);  // a row takes so long
    gaps.add(own_even_stamps ? due : sent);
  }
  return gaps.missing();
}

TEST(GapCounter, RowsThatAreOnlyLateAreNotMissing) {
  EXPECT_EQ(missingOf(9, true, 0), 0U) << "stamps k · 1 ms, whenever they come";
  EXPECT_EQ(missingOf(9, false, 0), 0U) << "stamps of the clock, rows sent late, then those that were due";
  EXPECT_EQ(missingOf(9, true, 3), 293U) << "three rows of each 50 never came";
  EXPECT_EQ(missingOf(2, false, 5), 489U) << "late and lost";
}

/// A program that sleeps until each row is due and stamps it then, as the example in the README, on a busy
/// computer: most wake-ups are late by a fraction of a period, and some by several.
TEST(GapCounter, LateWakeUpsAreNotMissing) {
  std::mt19937 random(11);
  std::exponential_distribution<double> late(1.0 / 0.3e-3);
  for (const int lost : {0, 9, 37}) {
    GapCounter gaps;
    double sent = 0.0;
    for (int k = 0; k < 20000; ++k) {
      sent = std::max(sent + 2e-5, 1e-3 * k + late(random));
      if (k < 1000 || k >= 1000 + lost) gaps.add(sent);
    }
    const double tolerance = 0.03 * lost;  // the period is known to about 2 %
    EXPECT_NEAR(static_cast<double>(gaps.missing()), lost, tolerance);
  }
}

/// Losses at random, of which many follow another within a few samples.
TEST(GapCounter, CountsLossesThatFollowEachOther) {
  for (const auto& [share, noise] : {std::pair{0.01, 0.0}, {0.1, 0.0}, {0.3, 0.0}, {0.1, 1e-4}}) {
    std::mt19937 random(2);
    std::bernoulli_distribution lost(share);
    std::normal_distribution<double> error(0.0, 1.0);
    GapCounter gaps;
    int missing = 0;
    for (int k = 0; k < 50000; ++k) {
      if (k > 2000 && k < 49900 && lost(random)) {
        ++missing;
        continue;
      }
      gaps.add(1e-3 * k + noise * error(random));
    }
    const double tolerance = noise > 0.0 ? 0.01 * missing : 0.0;
    EXPECT_NEAR(static_cast<double>(gaps.missing()), missing, tolerance) << share << " lost";
  }
}

/// Samples that came and were lost here are dropped, not missing.
TEST(GapCounter, SamplesThatAreCreditedAreNotMissing) {
  GapCounter gaps;
  for (int k = 0; k < 1000; ++k) {
    if (k >= 200 && k < 205) continue;  // lost here
    if (k >= 300 && k < 303) continue;  // never came
    if (k >= 400 && k < 404) continue;  // two of each
    if (k == 150) gaps.credit(5);       // known before the rows between
    if (k == 404) gaps.credit(2);
    if (k == 700) gaps.credit(900);  // those of a silence
    if (k == 801) continue;          // never came
    gaps.add(1e-3 * k + (k >= 700 ? 1.0 : 0.0));
  }
  EXPECT_EQ(gaps.missing(), 3U + 2U + 1U);
}

/// A sender that changes its rate: what was missing before stays, and nothing is missing for the change.
TEST(GapCounter, AnotherPeriodIsNoGap) {
  for (const double factor : {0.45, 2.0}) {
    GapCounter gaps;
    double t = 0.0;
    for (int k = 0; k < 10000; ++k) {
      t += k < 5000 ? 1e-3 : 1e-3 * factor;
      if (k < 4000 && k > 1000 && k % 50 == 0) continue;  // 59 of them
      gaps.add(t);
    }
    EXPECT_EQ(gaps.missing(), 59U) << factor;
  }
}

/// After a silence the rows that waited come with late times.
TEST(GapCounter, ABurstAfterASilenceTakesNothingBack) {
  GapCounter gaps;
  for (int k = 0; k < 4000; ++k)
    if (k < 1000 || k >= 1100) gaps.add(1e-3 * k);
  for (int k = 0; k < 500; ++k) gaps.add(4.5 + 2e-5 * k);
  EXPECT_EQ(gaps.missing(), 100U);
}

/// Bursts of more rows than a block of the period's estimate: the period stays that of the sender.
TEST(GapCounter, LongBurstsAreNoPeriod) {
  EXPECT_EQ(missingOf(200, true, 0), 0U);
  for (const int most : {40, 200}) EXPECT_LT(missingOf(most, false, 0), 250U) << "of 5000 rows";
}

}  // namespace
}  // namespace capstan::stats
