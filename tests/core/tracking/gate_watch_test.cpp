#include "core/tracking/gate_watch.h"

#include <gtest/gtest.h>

namespace capstan::tracking {
namespace {

using Said = std::optional<std::string>;

class GateWatchTest : public ::testing::Test {
 protected:
  Said observe(double t, Gate gate) {
    snapshot_.t = t, snapshot_.gate = gate, snapshot_.camera_updated = true;
    return watch_.observe(snapshot_);
  }
  Snapshot snapshot_{};
  GateWatch watch_;
};

TEST_F(GateWatchTest, ABlinkSaysNothing) {
  EXPECT_EQ(observe(0.0, Gate::kOpen), Said());
  EXPECT_EQ(observe(0.1, Gate::kBothLost), Said());
  EXPECT_EQ(observe(0.5, Gate::kBothLost), Said());
  EXPECT_EQ(observe(0.6, Gate::kOpen), Said());
}

TEST_F(GateWatchTest, SaysWhyTheCameraIsNotUsedAndForHowLong) {
  observe(1.0, Gate::kOpen);
  observe(1.1, Gate::kJump);
  EXPECT_EQ(observe(1.6, Gate::kJump), Said("camera not used: marker jumped"));
  EXPECT_EQ(observe(1.7, Gate::kJump), Said()) << "it was said";
  const Said other = observe(1.8, Gate::kLeftLost);
  ASSERT_TRUE(other);
  EXPECT_NE(*other, "camera not used: marker jumped");
  EXPECT_EQ(observe(3.1, Gate::kOpen), Said("camera used again after 2.0 s"));
  EXPECT_EQ(observe(3.2, Gate::kOpen), Said());
}

TEST_F(GateWatchTest, RestatesThatTheCameraIsNotUsed) {
  observe(1.1, Gate::kJump);
  observe(1.6, Gate::kJump);
  watch_.restate();
  EXPECT_EQ(observe(1.7, Gate::kJump), Said("camera not used: marker jumped"));
  EXPECT_EQ(observe(1.8, Gate::kJump), Said());
  EXPECT_EQ(observe(3.1, Gate::kOpen), Said("camera used again after 2.0 s"));
  watch_.restate();
  EXPECT_EQ(observe(3.2, Gate::kOpen), Said());
}

}  // namespace
}  // namespace capstan::tracking
