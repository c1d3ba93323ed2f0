#include "core/tracking/side_watch.h"

#include <gtest/gtest.h>

#include "core/tracking/side_text.h"

namespace capstan::tracking {
namespace {

using State = SideStatus::State;
using Sentences = std::vector<std::string>;

class SideWatchTest : public ::testing::Test {
 protected:
  Sentences observe(State state, double silent_for = 0.0) {
    side_.state = state, side_.silent_for = silent_for;
    side_.received += state == State::kReceiving;
    now_ += std::chrono::milliseconds(100);
    return watch_.observe({side_}, now_);
  }
  SideWatchTest() { side_.name = "motors", side_.from = "tcp://127.0.0.1:5555"; }

  SideStatus side_;
  SideWatch watch_;
  SideWatch::Clock::time_point now_{};
};

TEST_F(SideWatchTest, SaysEachChangeOnce) {
  EXPECT_EQ(observe(State::kWaiting), Sentences{});
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving"});
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
  EXPECT_EQ(observe(State::kSilent, 0.4), Sentences{"motors silent"});
  EXPECT_EQ(observe(State::kSilent, 2.1), Sentences{});
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving again after 2.1 s"});
  side_.fault = "line 7 is no row";
  EXPECT_EQ(observe(State::kRefused), Sentences{"motors refused: line 7 is no row"});
}

TEST_F(SideWatchTest, SaysWhyNothingComes) {
  EXPECT_EQ(observe(State::kWaiting), Sentences{});
  side_.from = "ros:/arm", side_.reason = "nobody publishes /arm";
  EXPECT_EQ(observe(State::kWaiting), Sentences{"motors: waiting: nobody publishes /arm"});
  EXPECT_EQ(observe(State::kWaiting), Sentences{}) << "once";
  side_.reason.clear();
  EXPECT_EQ(observe(State::kWaiting), Sentences{});
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving"});
  side_.reason = "a message is no JointState";
  EXPECT_EQ(observe(State::kReceiving), Sentences{}) << "others are";
}

TEST_F(SideWatchTest, SaysWhyACameraIsSilent) {
  observe(State::kReceiving);
  side_.name = "cameras", side_.part = "right";
  EXPECT_EQ(observe(State::kSilent, 0.4), Sentences{"right camera silent"});
  side_.reason = "http://10.0.0.2/right: no server answers there";
  EXPECT_EQ(observe(State::kSilent, 0.5),
            Sentences{"right camera silent: http://10.0.0.2/right: no server answers there"});
  EXPECT_EQ(observe(State::kSilent, 0.6), Sentences{}) << "once";
}

/// What is wrong with rows that are used: said while it lasts, and in the status line.
TEST_F(SideWatchTest, SaysWarnings) {
  observe(State::kReceiving);
  side_.warning = "joint 1 has left its limits";
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors: joint 1 has left its limits"});
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
  EXPECT_EQ(shortTextOf(side_), "motors: joint 1 has left its limits");
  EXPECT_TRUE(needsAttention(side_));
  side_.warning.clear();
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
}

/// Remarks on what a program sends: once, and again at the begin of a recording.
TEST_F(SideWatchTest, SaysRemarks) {
  side_.notices = {"columns not used: Q1"};
  EXPECT_EQ(observe(State::kReceiving), (Sentences{"motors receiving", "motors: columns not used: Q1"}));
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
  watch_.restate();
  EXPECT_EQ(observe(State::kReceiving), (Sentences{"motors receiving", "motors: columns not used: Q1"}));
  side_.notices = {"columns not used: Q2"};
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors: columns not used: Q2"});
}

TEST_F(SideWatchTest, SaysARefusalThatWasTooShortToBeSeen) {
  observe(State::kReceiving);
  side_.refused = 1, side_.fault = "line 7 is no row";
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors refused: line 7 is no row"});
  side_.refused = 2;
  EXPECT_EQ(observe(State::kRefused), Sentences{"motors refused: line 7 is no row"});
  EXPECT_EQ(observe(State::kRefused), Sentences{});
  side_.refused = 3;
  EXPECT_EQ(observe(State::kRefused), Sentences{}) << "the same again";
  side_.refused = 4, side_.fault = "line 9 is no row";
  EXPECT_EQ(observe(State::kRefused), Sentences{"motors refused: line 9 is no row"}) << "another one";
}

TEST_F(SideWatchTest, RestatesThePresentStateAndNothingOlder) {
  observe(State::kReceiving);
  side_.refused = 1, side_.fault = "line 7 is no row", side_.clock = SideClock{.steps = 1, .last_step = 0.5};
  observe(State::kReceiving);
  watch_.restate();
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving"}) << "refusal and step are of the past";
  EXPECT_EQ(observe(State::kReceiving), Sentences{}) << "once";
  observe(State::kSilent, 0.4);
  watch_.restate();
  EXPECT_EQ(observe(State::kSilent, 65.0), Sentences{"motors silent for 65.0 s"});
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving again after 65.0 s"});
}

TEST_F(SideWatchTest, SaysByWhatImagesAreDated) {
  using Times = SideStatus::Times;
  observe(State::kReceiving);
  side_.name = "cameras";
  const auto saidOf = [&](Times times, int calls) {
    Sentences all;
    side_.times = times;
    for (int k = 0; k < calls; ++k)
      for (const std::string& sentence : observe(State::kReceiving)) all.push_back(sentence);
    return all;
  };
  EXPECT_EQ(saidOf(Times::kStamps, 20), Sentences{"cameras: times of the images by stamps"});
  EXPECT_EQ(saidOf(Times::kArrivals, 5), Sentences{}) << "for a moment";
  EXPECT_EQ(saidOf(Times::kStamps, 20), Sentences{});
  EXPECT_EQ(saidOf(Times::kArrivals, 20),
            Sentences{"cameras: times of the images by arrivals, no longer by stamps"});
  watch_.restate();
  EXPECT_EQ(saidOf(Times::kArrivals, 20),
            (Sentences{"cameras receiving", "cameras: times of the images by arrivals"}));
}

TEST_F(SideWatchTest, SaysAGapInTheTimesThatNoSilenceHasAnnounced) {
  observe(State::kReceiving);
  side_.gaps = 1, side_.last_gap = 2.1;
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors: gap of 2.1 s in the times of the rows"});
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
  observe(State::kSilent, 3.0);
  side_.gaps = 2, side_.last_gap = 3.0;
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors receiving again after 3.0 s"});
}

TEST_F(SideWatchTest, SaysOnceThatEncodersDoNotMatch) {
  observe(State::kReceiving);
  side_.encoders.unmatched = 3;
  EXPECT_EQ(observe(State::kReceiving), Sentences{}) << "some messages were lost";
  side_.encoders.state = EncoderStatus::State::kOtherStamps;
  const Sentences said = observe(State::kReceiving);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("publish both with the stamp of one cycle"), std::string::npos) << said[0];
  EXPECT_EQ(shortTextOf(side_), said[0]) << "also in the status line";
  side_.encoders.unmatched = 1000;
  EXPECT_EQ(observe(State::kReceiving), Sentences{});
  side_.encoders.state = EncoderStatus::State::kUsed;
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors: joint encoders are used"});
}

TEST_F(SideWatchTest, SaysThatEncodersAreSilent) {
  observe(State::kReceiving);
  side_.encoders.state = EncoderStatus::State::kSilent, side_.encoders.from = "ros:/encoders";
  const Sentences said = observe(State::kReceiving);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said[0].find("no joint encoders from ros:/encoders"), std::string::npos) << said[0];
  EXPECT_EQ(shortTextOf(side_), said[0]) << "also in the status line";
  side_.encoders.state = EncoderStatus::State::kUsed;
  EXPECT_EQ(observe(State::kReceiving), Sentences{"motors: joint encoders are used"});
}

TEST_F(SideWatchTest, TheStatusLineCountsWhatWasLostOrExcluded) {
  observe(State::kReceiving);
  EXPECT_EQ(shortTextOf(side_), "");
  side_.missing = 2, side_.repeated = 1, side_.dropped = 30;
  EXPECT_EQ(shortTextOf(side_), "motors: 2 missing, 1 repeated, 30 dropped");
  side_.unpaired = 4, side_.frozen = 5;
  EXPECT_EQ(shortTextOf(side_), "motors: 2 missing, 1 repeated, 30 dropped, 4 unpaired, 5 frozen");
  EXPECT_FALSE(needsAttention(side_)) << "it is past";
}

TEST_F(SideWatchTest, TheStatusLineSaysThatTrackingIsSlowerThanTheRobot) {
  observe(State::kReceiving);
  side_.backlog = 0.1;
  EXPECT_FALSE(needsAttention(side_));
  side_.backlog = 2.34;
  EXPECT_TRUE(needsAttention(side_));
  EXPECT_EQ(shortTextOf(side_), "tracking is 2.3 s behind: it is slower than the incoming data");
}

TEST_F(SideWatchTest, NamesTheCameraAndTheStepOfAClock) {
  observe(State::kReceiving);
  side_.name = "cameras", side_.part = "left";
  EXPECT_EQ(observe(State::kFrozen, 0.4), Sentences{"left camera frozen"});
  side_.part = "";
  EXPECT_EQ(observe(State::kFrozen, 0.5), Sentences{"cameras frozen"}) << "now both are";
  side_.clock = SideClock{.steps = 1, .last_step = 0.5};
  EXPECT_EQ(observe(State::kFrozen, 0.6), Sentences{"cameras: clock stepped by +0.500 s"});
}

}  // namespace
}  // namespace capstan::tracking
