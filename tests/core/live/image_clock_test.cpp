#include "core/live/image_clock.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace capstan::live {
namespace {

constexpr std::int64_t kBegin = 1700000000000000000;  // [ns]
std::int64_t stampAt(double t) { return kBegin + std::llround(1e9 * t); }

/// Two cameras at 30 images/s, both exposed at the same times, with exponential delays of 20 ms.
struct Cameras {
  std::mt19937 random{4};
  double delay() { return 0.002 + std::exponential_distribution<double>(50.0)(random); }
};

TEST(ImageClock, StampsOfOneClockPairImagesWhateverTheirDelays) {
  for (const auto streams : {ImageClock::Streams::kOneClock, ImageClock::Streams::kMayDiffer}) {
    Cameras cameras;
    ImageClock clock(streams);
    for (int k = 0; k < 600; ++k) {
      const double t = k / 30.0;
      const double left = clock.add(0, stampAt(t), t + cameras.delay());
      const double right = clock.add(1, stampAt(t), t + cameras.delay());
      ASSERT_NEAR(left, right, 1e-9) << t;
      ASSERT_EQ(*clock.stampOf(left), stampAt(t));
      if (t > 2.0) {
        ASSERT_NEAR(clock.computerTime(left), t + 0.002, 2e-3) << t;
      }
    }
    EXPECT_FALSE(clock.separate());
  }
}

/// The clock of the right server is 7 s ahead, or only 0.3 s.
TEST(ImageClock, StampsOfTwoClocksAreMappedEach) {
  for (const double ahead : {7.0, -7.0, 0.3}) {
    Cameras cameras;
    ImageClock clock(ImageClock::Streams::kMayDiffer);
    for (int k = 0; k < 900; ++k) {
      const double t = k / 30.0;
      const double left = clock.add(0, stampAt(t), t + cameras.delay());
      const double right = clock.add(1, stampAt(t + ahead), t + cameras.delay());
      if (t < 2.0) continue;
      ASSERT_NEAR(left, right, 5e-3) << t;
      ASSERT_NEAR(clock.computerTime(left), t + 0.002, 5e-3) << t;
      ASSERT_FALSE(clock.stampOf(left));
    }
    EXPECT_TRUE(clock.separate());
  }
}

/// The right server sets its clock at 10 s: one clock from then on.
TEST(ImageClock, ClocksThatAreSetTogetherAreOneAgain) {
  Cameras cameras;
  ImageClock clock(ImageClock::Streams::kMayDiffer);
  for (int k = 0; k < 900; ++k) {
    const double t = k / 30.0;
    const double left = clock.add(0, stampAt(t), t + cameras.delay());
    const double right = clock.add(1, stampAt(t + (t < 10.0 ? 7.0 : 0.0)), t + cameras.delay());
    if (t < 13.0) continue;
    ASSERT_NEAR(left, right, 1e-9) << t;
    ASSERT_NEAR(clock.computerTime(left), t + 0.002, 5e-3) << t;
  }
}

/// Ten seconds in which the right images are 0.5 s late are no second clock.
TEST(ImageClock, AStreamThatIsLateHasNoClockOfItsOwn) {
  ImageClock clock(ImageClock::Streams::kMayDiffer);
  for (int k = 0; k < 900; ++k) {
    const double t = k / 30.0;
    const double left = clock.add(0, stampAt(t), t + 0.002);
    const double right = clock.add(1, stampAt(t), t + (t > 10.0 && t < 20.0 ? 0.5 : 0.002));
    ASSERT_NEAR(left, right, 1e-9) << t;
  }
}

TEST(ImageClock, OnlyOneSideHasStamps) {
  for (const auto streams : {ImageClock::Streams::kOneClock, ImageClock::Streams::kMayDiffer}) {
    ImageClock clock(streams);
    for (int k = 0; k < 300; ++k) {
      const double t = k / 30.0;
      const double left = clock.add(0, stampAt(t), t + 0.002);
      ASSERT_NEAR(clock.add(1, 0, t + 0.004), left, 3e-3) << t;
    }
  }
}

/// A missing stamp, and stamps of which one is wrong.
TEST(ImageClock, OneBadStampDoesNoHarm) {
  for (const double wrong : {0.0, 50.0, -50.0, 0.4}) {
    ImageClock clock(ImageClock::Streams::kOneClock);
    for (int k = 0; k < 300; ++k) {
      const double t = k / 30.0;
      const bool bad = k == 150;
      const std::int64_t stamp = !bad ? stampAt(t) : wrong == 0.0 ? 0 : stampAt(t + wrong);
      ASSERT_NEAR(clock.add(0, stamp, t + 0.002), t, 1e-6) << wrong << " at " << t;
      ASSERT_NEAR(clock.add(1, stampAt(t), t + 0.002), t, 1e-6);
    }
    EXPECT_EQ(clock.steps(), 0);
  }
}

TEST(ImageClock, WithoutStampsArrivalsCount) {
  ImageClock clock(ImageClock::Streams::kOneClock);
  EXPECT_EQ(clock.add(0, 0, 3.5), 3.5);
  EXPECT_EQ(clock.computerTime(3.5), 3.5);
  EXPECT_FALSE(clock.stampOf(3.5));
}

}  // namespace
}  // namespace capstan::live
