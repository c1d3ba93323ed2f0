/// What a recording of a live source says about pauses and about the sides of the source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <thread>

#include "core/live/runner.h"
#include "core/recording/session_source.h"
#include "core/tracking/make_pipeline.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::live {
namespace {

using namespace recording::testing;
using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::MatchesRegex;
using testing::UnorderedElementsAre;

/// A robot whose motor samples the test sends, one each millisecond.
class Robot {
 public:
  void send(int samples) {
    const std::lock_guard lock(mutex_);
    waiting_ += samples;
  }
  /// Time of the next sample [s].
  std::optional<double> take() {
    const std::lock_guard lock(mutex_);
    if (waiting_ == 0) return {};
    --waiting_;
    return 1e-3 * ++newest_;
  }
  bool waits() const {
    const std::lock_guard lock(mutex_);
    return waiting_ > 0;
  }
  void discard() {
    const std::lock_guard lock(mutex_);
    newest_ += waiting_;
    waiting_ = 0;
  }
  void setSides(std::vector<tracking::SideStatus> sides) {
    const std::lock_guard lock(mutex_);
    sides_ = std::move(sides);
  }
  std::vector<tracking::SideStatus> sides() const {
    const std::lock_guard lock(mutex_);
    return sides_;
  }

 private:
  mutable std::mutex mutex_;
  int waiting_ = 0, newest_ = 0;
  std::vector<tracking::SideStatus> sides_;
};

class RobotSource final : public tracking::Source {
 public:
  RobotSource(std::shared_ptr<Robot> robot, bool sender_waits) : robot_(std::move(robot)) {
    info_.title = "robot";
    info_.robot = raven();
    info_.real_time = true;
    info_.sender_waits = sender_waits;
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool ready(std::chrono::milliseconds) override {
    std::this_thread::sleep_for(1ms);
    return robot_->waits();
  }
  bool next(tracking::Sample& out) override {
    const double t = robot_->take().value();
    out = tracking::MotorSample{t, {80, -86, -480}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    return true;
  }
  void discard() override {
    if (!info_.sender_waits) robot_->discard();  // as LiveSource, which keeps rows
  }
  void block(bool, bool) override {}
  std::vector<tracking::SideStatus> sides() const override { return robot_->sides(); }

 private:
  std::shared_ptr<Robot> robot_;
  tracking::SourceInfo info_;
};

class LiveRunner : public ::testing::Test {
 protected:
  void begin(bool sender_waits) {
    auto source = std::make_unique<RobotSource>(robot_, sender_waits);
    auto pipeline = tracking::makePipeline(source->info());
    runner_ = std::make_unique<Runner>(std::move(source), std::move(pipeline));
  }
  void record() {
    runner_->startRecording(folder_ / "a.capstan", recording::headerOf(runner_->info(), "2026-11-21"));
    std::promise<void> begun;
    runner_->post([&](tracking::Source&, tracking::TrackingPipeline&) { begun.set_value(); });
    begun.get_future().wait();
  }
  /// Waits until the session's time is `t`.
  testing::AssertionResult comesTo(double t) {
    for (int k = 0; k < 1000 && runner_->status().t < t - 1e-9; ++k) std::this_thread::sleep_for(5ms);
    if (std::abs(runner_->status().t - t) < 1e-9) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "t = " << runner_->status().t;
  }
  std::vector<std::string> eventsAfterwards() {
    runner_.reset();
    return eventsOf("a.capstan");
  }
  std::vector<std::string> eventsOf(const char* file) const {
    std::vector<std::string> events;
    for (const auto& event : recording::readSessionEvents(folder_ / file))
      events.push_back(fmt::format("{:.3f} {}: {}", event.t, event.kind, event.text));
    return events;
  }

  /// Records 100 rows, then pauses; 300 more come during the pause.
  void pauseWhileRowsCome() {
    record();
    robot_->send(100);
    runner_->run();
    ASSERT_TRUE(comesTo(0.1));
    runner_->pause();
    ASSERT_TRUE(runner_->waitUntilIdle(5.0));
    robot_->send(300);
  }

  const TemporaryFolder folder_;
  const std::shared_ptr<Robot> robot_ = std::make_shared<Robot>();
  std::unique_ptr<Runner> runner_;
};

TEST_F(LiveRunner, ARecordingSaysThatItsSessionWasPaused) {
  begin(false);
  ASSERT_NO_FATAL_FAILURE(pauseWhileRowsCome());
  for (int k = 0; k < 1000 && robot_->waits(); ++k) std::this_thread::sleep_for(5ms);
  ASSERT_FALSE(robot_->waits()) << "discarded";
  runner_->run();
  robot_->send(100);
  ASSERT_TRUE(comesTo(0.5));
  EXPECT_EQ(runner_->report().motor_samples, 200U);
  EXPECT_THAT(eventsAfterwards(), ElementsAre("0.100 session: paused: samples that come are discarded",
                                              MatchesRegex("0.401 session: running again after [0-9.]+ s")));
}

TEST_F(LiveRunner, APauseDiscardsNothingOfASenderThatWaits) {
  begin(true);
  ASSERT_NO_FATAL_FAILURE(pauseWhileRowsCome());
  std::this_thread::sleep_for(100ms);
  EXPECT_TRUE(robot_->waits());
  runner_->run();
  ASSERT_TRUE(comesTo(0.4));
  EXPECT_EQ(runner_->report().motor_samples, 400U);
  EXPECT_THAT(eventsAfterwards(),
              ElementsAre("0.100 session: paused: the sender of the rows waits, images are discarded",
                          MatchesRegex("0.101 session: running again after [0-9.]+ s")));
}

/// Cameras that were silent, and a pause, since before the recording began.
TEST_F(LiveRunner, ARecordingBeginsWithThePresentState) {
  using State = tracking::SideStatus::State;
  tracking::SideStatus motors, cameras;
  motors.name = "motors", motors.state = State::kReceiving, motors.received = 100;
  cameras.name = "cameras", cameras.state = State::kSilent, cameras.received = 7;
  cameras.silent_for = 65.0, cameras.part = "right";
  robot_->setSides({motors, cameras});
  begin(false);
  robot_->send(100);
  runner_->run();
  ASSERT_TRUE(comesTo(0.1));
  record();
  robot_->send(100);
  ASSERT_TRUE(comesTo(0.2));
  runner_->pause();
  ASSERT_TRUE(runner_->waitUntilIdle(5.0));
  runner_->startRecording(folder_ / "b.capstan", recording::headerOf(runner_->info(), "2026-11-21"));
  ASSERT_TRUE(runner_->waitUntilIdle(5.0));
  std::this_thread::sleep_for(100ms);
  EXPECT_THAT(eventsAfterwards(),
              ElementsAre("0.100 source: motors receiving", "0.100 source: right camera silent for 65.0 s",
                          "0.200 session: paused: samples that come are discarded"));
  EXPECT_THAT(
      eventsOf("b.capstan"),
      UnorderedElementsAre("0.200 session: paused: samples that come are discarded",
                           "0.200 source: motors receiving", "0.200 source: right camera silent for 65.0 s"));
}

}  // namespace
}  // namespace capstan::live
