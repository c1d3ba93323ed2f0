/// What the motor side counts and says, with an input that the test fills.
#include "core/live/row_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <mutex>
#include <thread>

#include "core/robot/description.h"
#include "core/tracking/side_watch.h"

namespace capstan::live {
namespace {

using namespace std::chrono_literals;
using State = tracking::SideStatus::State;

/// Rows and counts that the test states.
struct Sent {
  std::mutex mutex;
  std::optional<recording::MeasuredTable> rows;
  LostMessages lost;
};

class SentRows final : public RowInput {
 public:
  explicit SentRows(std::shared_ptr<Sent> sent) : sent_(std::move(sent)) {}
  std::string name() const override { return "test"; }
  ReadState read(std::chrono::milliseconds) override {
    std::this_thread::sleep_for(1ms);
    const std::lock_guard lock(sent_->mutex);
    return sent_->rows ? ReadState::kBytes : ReadState::kNothing;
  }
  std::optional<recording::MeasuredTable> take() override {
    const std::lock_guard lock(sent_->mutex);
    return std::exchange(sent_->rows, std::nullopt);
  }
  void refuse(const std::string&) override {}
  void checkOrder(const recording::MeasuredTable&) override {}
  LostMessages lost() const override {
    const std::lock_guard lock(sent_->mutex);
    return sent_->lost;
  }

 private:
  std::shared_ptr<Sent> sent_;
};

class RowSideTest : public ::testing::Test {
 protected:
  void begin(RowSide::Faults faults, std::size_t capacity = 60000) {
    queue_ = std::make_unique<SampleQueue>(capacity);
    const robot::Description robot = robot::readDescriptionOrDefault({});
    side_ = std::make_unique<RowSide>(std::make_unique<SentRows>(sent_), robot,
                                      MotorArrangement({}, robot, {}), true, faults, *queue_);
  }
  /// Rows `first` to `last` − 1 of 1 kHz, without those for which `gone` is true.
  void send(int first, int last, const std::function<bool(int)>& gone = {}, LostMessages lost = {}) {
    recording::MeasuredTable table;
    table.file = "test";
    table.q_m.resize(3);
    for (int k = first; k < last; ++k) {
      if (gone && gone(k)) continue;
      table.t.push_back(1e-3 * k);
      for (std::size_t joint = 0; joint < 3; ++joint) table.q_m[joint].push_back(at_[joint]);
    }
    const std::lock_guard lock(sent_->mutex);
    sent_->rows = std::move(table);
    sent_->lost = lost;
  }
  bool receives(std::uint64_t rows) {
    for (int k = 0; k < 1000 && side_->status().received < rows; ++k) std::this_thread::sleep_for(5ms);
    return side_->status().received == rows;
  }

  std::array<double, 3> at_{80.0, -90.0, -480.0};  ///< where the motors stand [rad]
  const std::shared_ptr<Sent> sent_ = std::make_shared<Sent>();
  std::unique_ptr<SampleQueue> queue_;
  std::unique_ptr<RowSide> side_;
};

TEST_F(RowSideTest, MessagesThatAreLostHereAreDroppedAndNotMissing) {
  begin(RowSide::Faults::kDisconnect);
  send(0, 100);
  ASSERT_TRUE(receives(100));
  send(100, 300, [](int k) { return (k >= 150 && k < 170) || k == 200; }, {20, 7});
  ASSERT_TRUE(receives(279));
  EXPECT_EQ(side_->status().dropped, 27U) << "20 rows and 7 messages of encoders";
  EXPECT_EQ(side_->status().missing, 1U) << "row 200 never came";
}

/// This computer stalled: the rows of a second are gone, and none was awaited.
TEST_F(RowSideTest, ALongGapInTheTimesIsCountedAndSaid) {
  begin(RowSide::Faults::kDisconnect);
  tracking::SideWatch watch;
  send(0, 200);
  ASSERT_TRUE(receives(200));
  watch.observe({side_->status()});
  send(200, 1400, [](int k) { return k >= 250 && k < 1250; });
  ASSERT_TRUE(receives(400));
  EXPECT_EQ(side_->status().missing, 0U);
  EXPECT_EQ(side_->status().gaps, 1U);
  EXPECT_THAT(watch.observe({side_->status()}),
              ::testing::ElementsAre("motors: gap of 1.0 s in the times of the rows"));
}

/// A program that sends row by row: one damaged row is no joint beyond its limits, rows that stay there are.
TEST_F(RowSideTest, AJointIsBeyondItsLimitsWhenItStaysThere) {
  begin(RowSide::Faults::kDisconnect);
  send(0, 100);
  ASSERT_TRUE(receives(100));
  int sent = 100;
  const auto warnedAfter = [&](double position) {
    at_[0] = position;
    send(sent, sent + 1);
    EXPECT_TRUE(receives(static_cast<std::uint64_t>(++sent)));
    std::this_thread::sleep_for(210ms);
    return !side_->status().warning.empty();
  };
  EXPECT_FALSE(warnedAfter(-80.0));
  EXPECT_FALSE(warnedAfter(80.0));
  EXPECT_FALSE(warnedAfter(-80.0));
  EXPECT_FALSE(warnedAfter(-80.0));
  EXPECT_TRUE(warnedAfter(-80.0));
  EXPECT_FALSE(warnedAfter(80.0));
}

/// Tracking is paused or slow: the sender waits, and is not silent.
TEST_F(RowSideTest, ASenderThatHasToWaitIsNotSilent) {
  begin(RowSide::Faults::kEnd, 150);
  send(0, 100);
  ASSERT_TRUE(receives(100));
  send(100, 200);
  std::this_thread::sleep_for(600ms);
  EXPECT_EQ(side_->status().received, 100U) << "no room for the rows";
  EXPECT_EQ(side_->status().state, State::kReceiving);
  for (tracking::Sample sample; queue_->ready(100ms);) queue_->take(sample);
  ASSERT_TRUE(receives(200));
  EXPECT_EQ(side_->status().state, State::kReceiving);
  std::this_thread::sleep_for(600ms);
  EXPECT_EQ(side_->status().state, State::kSilent);
}

}  // namespace
}  // namespace capstan::live
