/// Joint encoders of a topic of their own, by stamps of every phase and rate.
#include "core/live/encoder_pairing.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace capstan::live {
namespace {

using State = tracking::EncoderStatus::State;

struct Joined {
  int rows = 0, with_encoders = 0;
  std::uint64_t unmatched = 0, late = 0;
  tracking::EncoderStatus::State state{};
};

/// A second of motors each `motor` ms and encoders each `encoder` ms, whose stamps are late by `late` s.
Joined joined(int motor, int encoder, double late, bool (*gone)(int) = nullptr) {
  EncoderPairing pairing(true);
  const EncoderPairing::Clock::time_point start{};
  Joined all;
  for (int k = 0; k < 1000 + 100; ++k) {
    const auto now = start + std::chrono::milliseconds(k);
    const double t = 1e-3 * k;
    if (k < 1000 && k % motor == 0 && !(gone && gone(k)))
      pairing.addMotors({now, {t, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}});
    if (k % encoder == 0) pairing.addEncoders({t + late, {t, 0, 0}}, now);
    for (EncoderPairing::Row row; pairing.take(now, row);) {
      ++all.rows;
      if (!row.joints) continue;
      ++all.with_encoders;
      EXPECT_EQ(row.joints->position[0], row.motors.t);
    }
  }
  all.unmatched = pairing.status().unmatched, all.late = pairing.status().late;
  all.state = pairing.status().state;
  return all;
}

TEST(EncoderPairing, EncodersOfOneCycleBelongToItsMotors) {
  for (const double late : {0.0, 1e-4, -1e-4}) {
    const Joined same = joined(1, 1, late);
    EXPECT_EQ(same.rows, 1000);
    EXPECT_EQ(same.with_encoders, 1000);
    EXPECT_EQ(same.unmatched, 0U);
  }
}

TEST(EncoderPairing, OtherRatesAndLostMessagesAreNoDisagreement) {
  EXPECT_EQ(joined(1, 10, 0.0).with_encoders, 100);
  EXPECT_EQ(joined(1, 10, 0.0).unmatched, 0U);
  EXPECT_EQ(joined(10, 1, 0.0).with_encoders, 100);
  EXPECT_EQ(joined(10, 1, 0.0).unmatched, 0U);
  EXPECT_EQ(joined(1, 1, 0.0, [](int k) { return k % 7 == 0; }).unmatched, 0U);
}

TEST(EncoderPairing, CountsRowsWhoseEncodersAreOutOfPhase) {
  for (const double late : {5e-4, -5e-4}) {
    const Joined apart = joined(1, 1, late);
    EXPECT_EQ(apart.rows, 1000);
    EXPECT_EQ(apart.with_encoders, 0);
    EXPECT_GE(apart.unmatched, 990U);
    EXPECT_EQ(apart.late, 0U);
    EXPECT_EQ(apart.state, State::kOtherStamps);
    EXPECT_GE(joined(1, 10, late).unmatched, 99U);
  }
}

/// A second of both at 1 kHz with one stamp a cycle, whose encoders arrive `delay` ms after their motors.
Joined delayed(int (*delay)(int)) {
  EncoderPairing pairing(true);
  const EncoderPairing::Clock::time_point start{};
  Joined all;
  int sent = 0;
  for (int k = 0; k < 1100; ++k) {
    const auto now = start + std::chrono::milliseconds(k);
    if (k < 1000) pairing.addMotors({now, {1e-3 * k, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}});
    for (; sent < 1000 && sent + delay(sent) <= k; ++sent) pairing.addEncoders({1e-3 * sent, {0, 0, 0}}, now);
    for (EncoderPairing::Row row; pairing.take(now, row);) {
      ++all.rows;
      all.with_encoders += row.joints.has_value();
      if (k == 999) all.state = pairing.status().state;
    }
  }
  all.unmatched = pairing.status().unmatched, all.late = pairing.status().late;
  return all;
}

TEST(EncoderPairing, LateEncodersAreNotTakenForOtherStamps) {
  EXPECT_EQ(delayed([](int) { return 15; }).with_encoders, 1000);
  const Joined late = delayed([](int) { return 30; });
  EXPECT_EQ(late.rows, 1000);
  EXPECT_EQ(late.with_encoders, 0);
  EXPECT_EQ(late.late, 1000U);
  EXPECT_EQ(late.unmatched, 0U);
  EXPECT_EQ(late.state, State::kLate);
}

TEST(EncoderPairing, AHiccupNowAndThenIsForgotten) {
  const Joined all = delayed([](int k) { return k % 100 < 90 ? 0 : 30; });
  EXPECT_GT(all.late, 50U);
  EXPECT_GT(all.with_encoders, 500);
  EXPECT_EQ(all.state, State::kUsed);
}

/// Motors from `begin` to `end` [ms] each ms, and encoders of the same stamps where `encoders`; the longest
/// time for which one of the rows waits.
int longestWait(EncoderPairing& pairing, int begin, int end, bool encoders) {
  const EncoderPairing::Clock::time_point start{};
  int longest = 0, oldest = begin;
  for (int k = begin; k < end; ++k) {
    const auto now = start + std::chrono::milliseconds(k);
    pairing.addMotors({now, {1e-3 * k, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}});
    if (encoders) pairing.addEncoders({1e-3 * k, {0, 0, 0}}, now);
    for (EncoderPairing::Row row; pairing.take(now, row); ++oldest) {
      longest = std::max(longest, k - oldest);
      EXPECT_EQ(row.joints.has_value(), encoders);
    }
  }
  return longest;
}

TEST(EncoderPairing, RowsDoNotWaitForSilentEncoders) {
  EncoderPairing pairing(true);
  EXPECT_GT(longestWait(pairing, 0, 300, false), 15) << "they may come later than their motors";
  EXPECT_EQ(pairing.status().state, State::kUsed);
  longestWait(pairing, 300, 400, false);
  EXPECT_EQ(pairing.status().state, State::kSilent);
  EXPECT_EQ(longestWait(pairing, 400, 1000, false), 0);
  EXPECT_EQ(longestWait(pairing, 1000, 1400, true), 0);
  EXPECT_EQ(pairing.status().state, State::kUsed) << "back";
}

TEST(EncoderPairing, ASilenceOfTheMotorsIsNoneOfTheEncoders) {
  EncoderPairing pairing(true);
  EXPECT_EQ(longestWait(pairing, 0, 100, true), 0);
  EXPECT_GT(longestWait(pairing, 5000, 5100, false), 15) << "after a pause of both";
  EXPECT_EQ(pairing.status().state, State::kUsed);
}

TEST(EncoderPairing, RestartsWhereStampsStepBack) {
  EncoderPairing pairing(true);
  const EncoderPairing::Clock::time_point now{};
  int with_encoders = 0;
  for (const double begin : {100.0, 0.0})
    for (int k = 0; k < 100; ++k) {
      pairing.addEncoders({begin + 1e-3 * k, {0, 0, 0}}, now);
      pairing.addMotors({now, {begin + 1e-3 * k, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}});
      for (EncoderPairing::Row row; pairing.take(now, row);) with_encoders += row.joints.has_value();
    }
  EXPECT_EQ(with_encoders, 200);
  EXPECT_EQ(pairing.status().late + pairing.status().unmatched, 0U);
}

TEST(EncoderPairing, HoldsABoundedNumberOfEncodersAndCountsOnWhereTheirClockIsAhead) {
  EncoderPairing pairing(true);
  const EncoderPairing::Clock::time_point now{};
  const auto haveEncoders = [&](double t) {
    pairing.addMotors({now, {t, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {}});
    EncoderPairing::Row row;
    EXPECT_TRUE(pairing.take(now, row));
    return row.joints.has_value();
  };
  constexpr int kMost = static_cast<int>(EncoderPairing::kMost);
  for (int k = 0; k < kMost + 500; ++k) pairing.addEncoders({1e-3 * k, {0, 0, 0}}, now);
  EXPECT_FALSE(haveEncoders(0.499)) << "the oldest are gone";
  EXPECT_TRUE(haveEncoders(0.500));
  EXPECT_EQ(pairing.status().unmatched, 1U);
  for (int k = 0; k < kMost + 100; ++k) {
    pairing.addEncoders({1000.0 + 1e-3 * k, {0, 0, 0}}, now);
    EXPECT_FALSE(haveEncoders(5.0 + 1e-3 * k));
  }
  EXPECT_GE(pairing.status().unmatched, 100U) << "a clock that is ahead by 1000 s";
}

}  // namespace
}  // namespace capstan::live
