/// Joint encoders of a topic of their own, by stamps of every phase and rate.
#include "core/live/encoder_pairing.h"

#include <gtest/gtest.h>

namespace capstan::live {
namespace {

struct Joined {
  int rows = 0, with_encoders = 0;
  std::uint64_t unmatched = 0;
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
    if (k % encoder == 0) pairing.addEncoders({t + late, {t, 0, 0}});
    for (EncoderPairing::Row row; pairing.take(now, row);) {
      ++all.rows;
      if (!row.joints) continue;
      ++all.with_encoders;
      EXPECT_EQ(row.joints->position[0], row.motors.t);
    }
  }
  all.unmatched = pairing.unmatched();
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
    EXPECT_GE(joined(1, 10, late).unmatched, 99U);
  }
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
  for (int k = 0; k < kMost + 500; ++k) pairing.addEncoders({1e-3 * k, {0, 0, 0}});
  EXPECT_FALSE(haveEncoders(0.499)) << "the oldest are gone";
  EXPECT_TRUE(haveEncoders(0.500));
  EXPECT_EQ(pairing.unmatched(), 1U);
  for (int k = 0; k < kMost + 100; ++k) {
    pairing.addEncoders({1000.0 + 1e-3 * k, {0, 0, 0}});
    EXPECT_FALSE(haveEncoders(5.0 + 1e-3 * k));
  }
  EXPECT_GE(pairing.unmatched(), 100U) << "a clock that is ahead by 1000 s";
}

}  // namespace
}  // namespace capstan::live
