/// Images of the two eyes by their times, in any order of arrival.
#include "core/live/cameras/frame_pairer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <random>
#include <utility>

namespace capstan::live {
namespace {

TEST(FramePairer, PairsByTimeAndCountsTheRest) {
  FramePairer pairer(0.01);
  const auto image = [](int value) { return cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(value)); };
  EXPECT_FALSE(pairer.add(0, 0.000, image(1)));
  const auto first = pairer.add(1, 0.004, image(2));
  ASSERT_TRUE(first);
  EXPECT_NEAR(first->t, 0.002, 1e-12);
  EXPECT_EQ(first->left.at<cv::Vec3b>(0, 0)[0], 1);
  EXPECT_EQ(first->right.at<cv::Vec3b>(0, 0)[0], 2);
  EXPECT_FALSE(pairer.add(0, 0.033, image(3)));
  EXPECT_FALSE(pairer.add(0, 0.066, image(3))) << "the right image of 0.033 was lost";
  EXPECT_TRUE(pairer.add(1, 0.067, image(4)));
  EXPECT_FALSE(pairer.add(1, 0.100, image(5)));
  EXPECT_FALSE(pairer.add(0, 0.133, image(6))) << "the left image of 0.100 was lost";
  EXPECT_TRUE(pairer.add(1, 0.134, image(7)));
  EXPECT_EQ(pairer.unpaired(), 2U);
  EXPECT_EQ(pairer.frozen(), 1U) << "twice the same left image";
}

cv::Mat imageOf(int value) { return {2, 2, CV_16UC1, cv::Scalar::all(value)}; }
int valueOf(const cv::Mat& image) { return image.at<std::uint16_t>(0, 0); }
double timeOf(int k) { return k / 30.0; }

/// A busy computer gives one camera's reader the processor for some images, then the other's.
TEST(FramePairer, PairsBurstsOfOneSideWithThoseOfTheOther) {
  FramePairer pairer(0.012);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> burst(1, 8);
  std::uniform_real_distribution<double> between(0.0, 0.011);
  std::array<int, 2> next = {0, 0};
  int pairs = 0;
  constexpr int kImages = 1200;
  for (int side = 0; next[0] < kImages || next[1] < kImages; side = 1 - side) {
    const auto s = static_cast<std::size_t>(side);
    const int end = std::min({next[s] + burst(random), kImages, next[1 - s] + 12});
    for (; next[s] < end; ++next[s]) {
      const auto pair =
          pairer.add(side, timeOf(next[s]) + (side == 1 ? between(random) : 0.0), imageOf(next[s]));
      if (!pair) continue;
      EXPECT_EQ(valueOf(pair->left), valueOf(pair->right));
      EXPECT_EQ(valueOf(pair->left), pairs) << "in order, none missing";
      ++pairs;
    }
  }
  EXPECT_EQ(pairs, kImages);
  EXPECT_EQ(pairer.unpaired(), 0U);
  EXPECT_EQ(pairer.dropped(), 0U);
}

/// A reader that is behind drops the oldest images of its side: their pairs are dropped, and no image of the
/// other side is called unpaired.
TEST(FramePairer, ImagesThatAReaderDropsAreDroppedPairs) {
  std::mt19937 random(5);
  std::bernoulli_distribution drops(0.2);
  FramePairer pairer(0.012);
  std::array<std::uint64_t, 2> lost = {0, 0};
  std::uint64_t pairs = 0, dropped = 0;
  constexpr int kImages = 2000;
  for (int k = 0; k < kImages; ++k) {
    const bool may_drop = k < kImages - 1;
    const std::array<bool, 2> gone = {may_drop && drops(random), may_drop && drops(random)};
    dropped += gone[0] || gone[1];
    const std::size_t first = random() % 2;
    for (const std::size_t side : {first, 1 - first}) {
      if (gone[side]) {
        ++lost[side];
        continue;
      }
      const auto pair =
          pairer.add(static_cast<int>(side), timeOf(k), imageOf(k), std::exchange(lost[side], 0));
      if (!pair) continue;
      ++pairs;
      EXPECT_EQ(valueOf(pair->left), valueOf(pair->right));
    }
  }
  EXPECT_EQ(pairer.unpaired(), 0U);
  EXPECT_EQ(pairer.dropped(), dropped);
  EXPECT_EQ(pairs, kImages - dropped);
  EXPECT_EQ(pairer.missing(), 0U) << "what is dropped came";
}

TEST(FramePairer, WhatACameraDoesNotGiveIsUnpairedBesideWhatAReaderDrops) {
  FramePairer pairer(0.012);
  for (int k = 0; k < 10; ++k) {
    pairer.add(0, timeOf(k), imageOf(k));
    if (k == 3 || k == 4 || k == 7) continue;  // 3 and 4: dropped by the reader; 7: never given
    EXPECT_TRUE(pairer.add(1, timeOf(k), imageOf(k), k == 5 ? 2 : 0)) << k;
  }
  EXPECT_EQ(pairer.dropped(), 2U);
  EXPECT_EQ(pairer.unpaired(), 1U);
}

/// A pair counts once: as missing, unpaired or frozen.
TEST(FramePairer, OnlyPairsOfWhichNeitherImageCameAreMissing) {
  FramePairer pairer(0.012);
  for (int k = 0; k < 300; ++k) {
    if (k == 100 || k == 101 || k == 200) continue;  // neither camera gave one
    if (k % 20 != 7) pairer.add(0, timeOf(k), imageOf(k));
    if (k % 20 != 13) pairer.add(1, timeOf(k) + 0.002, imageOf(k % 20 == 3 ? k - 1 : k));
  }
  EXPECT_EQ(pairer.missing(), 3U);
  EXPECT_EQ(pairer.unpaired(), 30U);
  EXPECT_EQ(pairer.frozen(), 15U);
}

/// Two cameras in turn: no pair comes, and none is missing, before as after they are synchronised.
TEST(FramePairer, NothingIsMissingWhereCamerasAreNotSynchronised) {
  FramePairer pairer(0.012);
  std::uint64_t pairs = 0;
  for (int k = 0; k < 400; ++k) {
    pairs += pairer.add(0, timeOf(k), imageOf(k)).has_value();
    pairs += pairer.add(1, timeOf(k) + (k < 200 ? 0.0165 : 0.0), imageOf(k)).has_value();
  }
  EXPECT_GE(pairs, 199U);
  EXPECT_LE(pairer.missing(), 1U);
  EXPECT_GE(pairer.unpaired(), 398U);
}

TEST(FramePairer, HoldsABoundedNumberOfImagesOfASingleCamera) {
  FramePairer pairer(0.012);
  for (int k = 0; k < 100; ++k) EXPECT_FALSE(pairer.add(0, timeOf(k), imageOf(k)));
  EXPECT_EQ(pairer.unpaired(), 100 - FramePairer::kMost);
  EXPECT_TRUE(pairer.add(1, timeOf(99), imageOf(99)));
  EXPECT_EQ(pairer.unpaired(), 99U);
}

TEST(FramePairer, GoesOnWhereTheClockStepsBack) {
  FramePairer pairer(0.012);
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(pairer.add(0, 10.0 + timeOf(k), imageOf(k)));
  int pairs = 0;
  for (int k = 3; k < 10; ++k) {
    pairs += pairer.add(1, 9.0 + timeOf(k), imageOf(k)).has_value();
    pairs += pairer.add(0, 9.0 + timeOf(k), imageOf(k)).has_value();
  }
  EXPECT_EQ(pairs, 6) << "the first right image after the step meets old ones";
  EXPECT_EQ(pairer.unpaired(), 5U);
}

}  // namespace
}  // namespace capstan::live
