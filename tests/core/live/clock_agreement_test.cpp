/// A session of motor samples and images with stamps, whose arrivals are made up.
#include "core/live/streams/clock_agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/live/streams/clock_map.h"

namespace capstan::live {
namespace {

using Verdict = ClockAgreement::Verdict;

/// Maps of both sides, and what they have agreed on.
class Session {
 public:
  /// Delay of rows and images [s], and how much the clock of the images is ahead [s], at a time.
  std::function<double(double)> rows_late = [](double) { return 0.0; };
  std::function<double(double)> images_late = [](double) { return 0.0; };
  std::function<double(double)> ahead = [](double) { return 0.0; };

  int undecided = 0;  ///< number of images

  /// Plays up to `end` and calls `each` with the time of every image and whether the clocks agree.
  void play(double end, const std::function<void(double, bool)>& each) {
    for (; t_ < end; t_ += 0.01) {
      motors_.add(t_, t_ + 0.001 + rows_late(t_));
      if (++count_ % 3 != 0) continue;
      const double stamp = t_ + ahead(t_);
      images_.add(stamp, t_ + 0.03 + images_late(t_));
      const double by_arrival = motors_.toDevice(images_.toSession(stamp));
      const Verdict verdict = agreement_.add(by_arrival - stamp, images_.steps(), t_);
      undecided += verdict == Verdict::kUndecided;
      each(t_, verdict == Verdict::kAgree);
    }
  }

 private:
  double t_ = 0.0;
  int count_ = 0;
  ClockMap motors_, images_;
  ClockAgreement agreement_;
};

/// Rows, images or both are late by more than a second, for seconds or for minutes.
TEST(ClockAgreement, LastsWhileEverythingIsLate) {
  const auto late = [](double amount, double until) {
    return [=](double t) { return t > 5.0 && t < until ? amount : 0.0; };
  };
  for (const double until : {9.0, 25.0, 180.0})
    for (const auto& [rows, images] : {std::pair{1.5, 0.0}, {0.0, 1.5}, {1.1, 1.5}, {1.5, 1.1}}) {
      Session session;
      session.rows_late = late(rows, until), session.images_late = late(images, until);
      session.play(200.0,
                   [&](double t, bool agree) { ASSERT_TRUE(agree) << rows << " " << images << " " << t; });
    }
}

/// A computer that is busy at the start: later than kLate, an image has no time; it never has that of its
/// arrival.
TEST(ClockAgreement, LateImagesAtTheStartAreNotOfAnotherClock) {
  for (const double late : {0.4, 1.0, 3.0}) {
    Session session;
    session.images_late = [=](double t) { return std::max(0.0, late * (1.0 - t / 1.5)); };
    int agreed = 0, images = 0;
    session.play(20.0, [&](double, bool agree) { agreed += agree, ++images; });
    EXPECT_EQ(agreed + session.undecided, images) << late;
    EXPECT_EQ(session.undecided > 0, late > ClockAgreement::kLate) << late;
    EXPECT_LT(session.undecided, 30) << late;
  }
}

/// Images that are late all the time, by more than the filter's memory, keep their stamps: at worst they are
/// not used.
TEST(ClockAgreement, ImagesThatAreAlwaysLateKeepTheirStamps) {
  Session session;
  session.images_late = [](double) { return 0.4; };
  session.play(60.0, [](double t, bool agree) { ASSERT_TRUE(agree) << t; });
}

TEST(ClockAgreement, DifferentClocksAreRecognised) {
  for (const double offset : {3.0, -3.0, 0.3, 300.0, -300.0}) {
    Session session;
    session.ahead = [=](double) { return offset; };
    session.rows_late = [](double t) { return t > 5.0 && t < 9.0 ? 1.5 : 0.0; };
    session.play(60.0, [&](double t, bool agree) { ASSERT_FALSE(agree) << offset << " at " << t; });
    const double images = std::abs(offset) > ClockAgreement::kFar ? 0.0 : ClockAgreement::kDecide / 0.03;
    EXPECT_NEAR(session.undecided, images, 2.0) << offset;
  }
}

TEST(ClockAgreement, EndsWhereAClockSteps) {
  for (const double step : {3.0, -3.0, 0.5, -0.5}) {
    Session session;
    session.ahead = [=](double t) { return t > 20.0 ? step : 0.0; };
    session.play(60.0, [&](double t, bool agree) {
      if (t < 20.0) {
        ASSERT_TRUE(agree) << step << " at " << t;
      }
      if (t > 20.6) {
        ASSERT_FALSE(agree) << step << " at " << t;
      }
    });
  }
}

/// A clock that comes back is one clock again.
TEST(ClockAgreement, BeginsAgainWhereTheStepIsTakenBack) {
  Session session;
  session.ahead = [](double t) { return t > 20.0 && t < 30.0 ? 3.0 : 0.0; };
  session.play(60.0, [&](double t, bool agree) {
    if (t > 20.6 && t < 30.0) {
      ASSERT_FALSE(agree) << t;
    }
    if (t > 30.6) {
      ASSERT_TRUE(agree) << t;
    }
  });
}

/// 100 ppm from 100 s on: after an hour the clocks are 0.35 s apart.
TEST(ClockAgreement, EndsWhereClocksHaveDriftedApart) {
  for (const double drift : {1e-4, -1e-4}) {
    ClockAgreement agreement;
    bool agree = true;
    double ended = 0.0;
    for (double t = 0.0; t < 7200.0; t += 0.1) {
      agree = agreement.add(0.03 + drift * t, 0, t) == Verdict::kAgree;
      if (!agree && ended == 0.0) ended = t;
    }
    EXPECT_FALSE(agree);
    EXPECT_GT(ended, 0.1 / std::abs(drift)) << "not before 0.1 s";
    EXPECT_LT(ended, 0.4 / std::abs(drift));
  }
}

/// Before kPairs have agreed, every pair decides for itself, as a single one within the bounds is no proof.
TEST(ClockAgreement, NeedsPairsOneAfterTheOther) {
  ClockAgreement agreement;
  for (int k = 0; k < ClockAgreement::kPairs - 1; ++k)
    EXPECT_EQ(agreement.add(0.03, 0, k / 30.0), Verdict::kAgree);
  EXPECT_EQ(agreement.add(1.5, 0, 1.0), Verdict::kDiffer);
  EXPECT_EQ(agreement.add(0.03, 0, 1.1), Verdict::kAgree);
  EXPECT_EQ(agreement.add(1.5, 0, 1.2), Verdict::kDiffer);
  for (int k = 0; k < ClockAgreement::kPairs; ++k)
    EXPECT_EQ(agreement.add(0.03, 0, 2.0 + k / 30.0), Verdict::kAgree);
  EXPECT_EQ(agreement.add(1.5, 0, 3.0), Verdict::kAgree);
}

}  // namespace
}  // namespace capstan::live
