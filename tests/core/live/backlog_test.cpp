#include "core/live/cameras/backlog.h"

#include <gtest/gtest.h>

namespace capstan::live {
namespace {

TEST(Backlog, HoldsTheFirstSecondAndWhatFollowsASilence) {
  Backlog backlog;
  for (int k = 0; k < 30; ++k) EXPECT_TRUE(backlog.add(5.0 + k / 30.0)) << k;
  for (int k = 30; k < 60; ++k) EXPECT_FALSE(backlog.add(5.0 + k / 30.0)) << k;
  for (const double late : {0.0, 0.2, 0.49}) EXPECT_TRUE(backlog.add(7.47 + late)) << "after 0.5 s: " << late;
  EXPECT_FALSE(backlog.add(7.98));
  EXPECT_FALSE(backlog.add(8.3)) << "no silence";
  EXPECT_TRUE(backlog.add(20.0));
  for (const double late : {0.3, 0.6, 0.9}) EXPECT_TRUE(backlog.add(20.0 + late)) << late;
  EXPECT_FALSE(backlog.add(21.05)) << "no more than a second";
}

TEST(Backlog, ASlowStreamHasNoSilences) {
  for (const double period : {0.5, 0.9}) {
    Backlog backlog;
    for (int k = 0; k < 3; ++k) backlog.add(period * k);
    for (int k = 3; k < 20; ++k) EXPECT_FALSE(backlog.add(period * k)) << period << ", " << k;
    EXPECT_TRUE(backlog.add(period * 19 + 4.0));
  }
}

/// Each image is late by another time, as on a wireless network.
TEST(Backlog, AStreamThatStallsOftenIsUsedBetweenItsStalls) {
  Backlog backlog;
  int used = 0;
  double t = 0.0;
  for (int k = 0; k < 200; ++k) used += !backlog.add(t += k % 20 == 0 ? 0.5 : 0.06);
  EXPECT_GT(used, 50);
}

TEST(Backlog, BeginsAgainWithTheStream) {
  Backlog backlog;
  EXPECT_FALSE(backlog.waits()) << "nothing has come";
  for (int k = 0; k <= 45; ++k) backlog.add(k / 30.0);
  EXPECT_FALSE(backlog.waits());
  backlog.restart();
  EXPECT_FALSE(backlog.waits());
  EXPECT_TRUE(backlog.add(1.6));
  EXPECT_TRUE(backlog.waits());
}

}  // namespace
}  // namespace capstan::live
