#include "core/live/runner.h"

#include <gtest/gtest.h>

#include <thread>

#include "core/base/due_times.h"
#include "core/base/error.h"
#include "core/live/playback_clock.h"
#include "core/live/rate_meter.h"
#include "core/recording/session_source.h"
#include "core/tracking/make_pipeline.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::live {
namespace {

using namespace recording::testing;

/// Motors at 1 kHz near the middle of the workspace, joints with them, frames (no marker) or tips at 15 Hz.
class MadeSource : public tracking::Source {
 public:
  MadeSource(double duration, bool images, int fail_at = -1) : images_(images), fail_at_(fail_at) {
    info_.title = "made";
    info_.robot = raven();
    info_.duration = duration;
    info_.reference = true;
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    const double t = tick_ * 1e-3;
    if (t > info_.duration) return false;
    if (tick_ == fail_at_) throw base::InputError({"made", 0, {}, {}, "broke", "Mend it"});
    const int part = part_++;
    if (part == 0) {
      out = tracking::MotorSample{t, Eigen::Vector3d(80, -86, -480).array() + 10 * std::sin(t),
                                  Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    } else if (part == 1 && tick_ % 66 == 0) {
      if (images_)
        out = tracking::StereoFrame{t, t, cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(blocked_ ? 9 : 99)),
                                    cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(99))};
      else
        out = tracking::TipSample{t, t, Eigen::Vector3d::Constant(kNaN)};
    } else {
      out = tracking::JointSample{t, {0.6, 1.6, 0.34}};
      ++tick_;
      part_ = 0;
    }
    return true;
  }
  void block(bool left, bool) override { blocked_ = left; }

 private:
  tracking::SourceInfo info_;
  bool images_, blocked_ = false;
  int fail_at_, tick_ = 0, part_ = 0;
};

/// Motors alone at 1 kHz, whose clock is set back by 3 s after 4 s.
class SetBackSource : public tracking::Source {
 public:
  SetBackSource() {
    info_.title = "set back";
    info_.robot = raven();
  }
  const tracking::SourceInfo& info() const override { return info_; }
  bool next(tracking::Sample& out) override {
    if (tick_ == 6000) return false;
    const double t = (tick_ < 4000 ? tick_ : tick_ - 3000) * 1e-3;
    out = tracking::MotorSample{t, {80, -86, -480}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    ++tick_;
    return true;
  }
  void block(bool, bool) override {}

 private:
  tracking::SourceInfo info_;
  int tick_ = 0;
};

std::unique_ptr<Runner> makeRunner(double duration, bool images = false, double speed = 0.0,
                                   int fail_at = -1) {
  auto source = std::make_unique<MadeSource>(duration, images, fail_at);
  auto pipeline = tracking::makePipeline(source->info());
  RunnerOptions options;
  options.speed = speed;
  return std::make_unique<Runner>(std::move(source), std::move(pipeline), options);
}

TEST(Runner, StartsPausedRunsToTheEndAndSaysSo) {
  const auto runner = makeRunner(2.0);
  EXPECT_EQ(runner->status().state, RunState::kPaused);
  tracking::Snapshot snapshot;
  EXPECT_FALSE(runner->takeSnapshot(snapshot));
  runner->run();
  ASSERT_TRUE(runner->waitUntilIdle(30.0));
  EXPECT_EQ(runner->status().state, RunState::kEnded);
  EXPECT_NEAR(runner->status().t, 2.0, 1e-9);
  ASSERT_TRUE(runner->takeSnapshot(snapshot));
  EXPECT_EQ(snapshot.motor_samples, 2001U);
  EXPECT_FALSE(runner->takeSnapshot(snapshot)) << "the same one twice";
}

TEST(Runner, TheReportIsThatOfABatchRun) {
  const auto runner = makeRunner(2.0);
  runner->run();
  ASSERT_TRUE(runner->waitUntilIdle(30.0));
  MadeSource source(2.0, false);
  auto pipeline = tracking::makePipeline(source.info());
  const auto batch = tracking::trackAll(source, pipeline);
  const auto live = runner->report();
  EXPECT_EQ(live.motor_samples, batch.motor_samples);
  EXPECT_EQ(live.errors.ukf().count(), batch.errors.ukf().count());
  EXPECT_TRUE(
      sameBits(Eigen::Vector3d(live.errors.ukf().value()), Eigen::Vector3d(batch.errors.ukf().value())));
  EXPECT_TRUE(sameBits(Eigen::Vector3d(live.errors.kinematic().value()),
                       Eigen::Vector3d(batch.errors.kinematic().value())));
}

TEST(Runner, AStepTakesOneCameraSample) {
  const auto runner = makeRunner(2.0);
  for (std::uint64_t step = 1; step <= 4; ++step) {
    runner->stepFrame();
    ASSERT_TRUE(runner->waitUntilIdle(30.0));
    tracking::Snapshot snapshot;
    ASSERT_TRUE(runner->takeSnapshot(snapshot));
    EXPECT_EQ(snapshot.camera_samples, step);
    EXPECT_EQ(runner->status().state, RunState::kPaused);
  }
}

TEST(Runner, HistoryHasEveryCameraUpdateAndTheRateAsked) {
  const auto runner = makeRunner(2.0);
  runner->run();
  ASSERT_TRUE(runner->waitUntilIdle(30.0));
  std::vector<tracking::Snapshot> history;
  const std::size_t drained = runner->drainHistory(history);
  EXPECT_EQ(drained, history.size());
  const auto updates =
      std::count_if(history.begin(), history.end(), [](const auto& s) { return s.camera_updated; });
  EXPECT_EQ(updates, 31);
  const auto motors =
      std::count_if(history.begin(), history.end(), [](const auto& s) { return s.motor_updated; });
  EXPECT_NEAR(static_cast<double>(motors), 400.0, 5.0);
  const auto references =
      std::count_if(history.begin(), history.end(), [](const auto& s) { return s.reference_paired; });
  EXPECT_NEAR(static_cast<double>(references), static_cast<double>(motors), 1.0);
  EXPECT_EQ(drained, static_cast<std::size_t>(updates + motors + references));
  EXPECT_TRUE(
      std::is_sorted(history.begin(), history.end(), [](const auto& a, const auto& b) { return a.t < b.t; }));
  EXPECT_EQ(runner->drainHistory(history), 0U);
}

TEST(Runner, ABrokenSourceIsAState) {
  const auto runner = makeRunner(2.0, false, 0.0, 500);
  runner->run();
  ASSERT_TRUE(runner->waitUntilIdle(30.0));
  EXPECT_EQ(runner->status().state, RunState::kFailed);
  EXPECT_NE(runner->status().error.find("broke"), std::string::npos);
}

TEST(Runner, RecordsWhatItRunsWithOcclusionAndRegistration) {
  const TemporaryFolder folder;
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.1, 0.2, 0.3));
  {
    const auto runner = makeRunner(4.0, true);
    recording::RecorderOptions options;
    options.width = 64;
    options.height = 48;
    options.buffered_time = 10.0;
    runner->startRecording(folder / "a.capstan", recording::headerOf(runner->info(), "2026-11-21"), options);
    runner->setRegistration(pose);
    runner->setOcclusion({50.0, 1.0, 0.0});
    runner->run();
    ASSERT_TRUE(runner->waitUntilIdle(60.0));
    runner->stopRecording();
    ASSERT_TRUE(runner->status().recorder);
  }
  const recording::SessionSummary summary = recording::readSessionSummary(folder / "a.capstan");
  EXPECT_EQ(summary.motor, 4001);
  EXPECT_EQ(summary.estimates, 4001);  // images without a rig are no camera updates
  ASSERT_TRUE(summary.header.base_from_camera);
  EXPECT_EQ(summary.header.base_from_camera->matrix(), pose.matrix());
  EXPECT_FALSE(summary.header.tracking.empty());
  int blocked = 0, scheduled = 0;
  for (const auto& event : recording::readSessionEvents(folder / "a.capstan")) {
    blocked += event.text == "both blocked, added to a recording";
    scheduled +=
        event.text == "both cameras blocked 50 % of the time, in intervals of 1.0 s, added to a recording";
  }
  EXPECT_EQ(blocked, 2) << "this source is not live";
  EXPECT_EQ(scheduled, 1);

  recording::SessionSource source(folder / "a.capstan");
  const OcclusionSchedule schedule{50.0, 1.0, 0.0};
  int frames = 0;
  for (tracking::Sample sample; source.next(sample);)
    if (const auto* frame = std::get_if<tracking::StereoFrame>(&sample)) {
      EXPECT_EQ(frame->left.at<cv::Vec3b>(3, 3)[0], schedule.blockedAt(frame->t) ? 9 : 99) << frame->t;
      ++frames;
    }
  EXPECT_EQ(frames, 61);
}

TEST(Runner, FramesComeWithWhatThePipelineMadeOfThem) {
  const auto runner = makeRunner(1.0, true);
  tracking::StereoFrame frame;
  tracking::Snapshot seen;
  EXPECT_FALSE(runner->takeFrames(frame));
  for (int step = 0; step < 3; ++step) {
    runner->stepFrame();
    ASSERT_TRUE(runner->waitUntilIdle(30.0));
    ASSERT_TRUE(runner->takeFrames(frame, &seen));
    EXPECT_EQ(frame.t, 0.066 * step);
    EXPECT_EQ(seen.t, 0.066 * step);
  }
  EXPECT_FALSE(runner->takeFrames(frame, &seen));
}

TEST(Runner, CommandsRunInOrderOnItsThreadAndTheirFaultsAreTold) {
  const auto runner = makeRunner(1.0);
  std::vector<int> order;
  std::thread::id thread;
  runner->post([&](tracking::Source&, tracking::TrackingPipeline&) { order.push_back(1); });
  runner->post([&](tracking::Source&, tracking::TrackingPipeline&) {
    order.push_back(2);
    thread = std::this_thread::get_id();
  });
  runner->post([](tracking::Source&, tracking::TrackingPipeline&) {
    throw base::InputError({"x", 0, {}, {}, "no", {}});
  });
  runner->post([](tracking::Source&, tracking::TrackingPipeline&) {
    throw base::InputError({"y", 0, {}, {}, "never", {}});
  });
  ASSERT_TRUE(runner->waitUntilIdle(30.0));
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
  EXPECT_NE(thread, std::this_thread::get_id());
  EXPECT_NE(runner->status().command_fault.find("y: never"), std::string::npos)
      << runner->status().command_fault;
  EXPECT_EQ(runner->status().command_fault_count, 2U);
  EXPECT_TRUE(runner->status().error.empty()) << "of the run itself, which goes on";
  EXPECT_EQ(runner->status().state, RunState::kPaused);
}

TEST(Runner, HistoryAndEstimatesGoOnWhenTheClockIsSetBack) {
  const TemporaryFolder folder;
  auto source = std::make_unique<SetBackSource>();
  auto pipeline = tracking::makePipeline(source->info());
  RunnerOptions options;
  options.speed = 0.0;
  Runner runner(std::move(source), std::move(pipeline), options);
  runner.startRecording(folder / "back.capstan", header());
  runner.run();
  ASSERT_TRUE(runner.waitUntilIdle(30.0));
  std::vector<tracking::Snapshot> history;
  runner.drainHistory(history);
  const auto back = std::adjacent_find(history.begin(), history.end(),
                                       [](const auto& a, const auto& b) { return b.t < a.t; });
  ASSERT_NE(back, history.end()) << "nothing after the clock was set back";
  EXPECT_NEAR(static_cast<double>(back + 1 - history.begin()), 800.0, 5.0);
  EXPECT_NEAR(static_cast<double>(history.end() - (back + 1)), 400.0, 5.0) << "the two seconds after it";
  runner.stopRecording();
  for (int i = 0; i < 1000 && runner.status().recorder->state != recording::RecorderState::kClosed; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const auto stats = *runner.status().recorder;
  EXPECT_EQ(stats.state, recording::RecorderState::kClosed);
  EXPECT_EQ(stats.written + stats.dropped, 6000U + 6000U - 9U) << "nine refused samples make no estimate";
}

TEST(DueTimes, KeepTheRateThroughGapsAndClocksSetBack) {
  base::DueTimes times(4.0);
  EXPECT_TRUE(times.due(10.0));
  EXPECT_TRUE(times.due(10.25));
  EXPECT_FALSE(times.due(10.375));
  EXPECT_TRUE(times.due(17.0)) << "after a gap";
  EXPECT_FALSE(times.due(17.125));
  EXPECT_TRUE(times.due(3.0)) << "set back";
  EXPECT_FALSE(times.due(3.125));
  EXPECT_TRUE(times.due(3.25));
  times.restart();
  EXPECT_TRUE(times.due(3.375));
  EXPECT_FALSE(base::DueTimes(0.0).due(1.0));
}

TEST(RateMeter, CountsOnWhenTheClockIsSetBack) {
  using namespace std::chrono_literals;
  RateMeter meter;
  const RateMeter::Clock::time_point start{};
  meter.look(100.0, start);
  meter.look(1.0, start + 100ms);
  for (int i = 0; i < 1000; ++i) meter.count(true, false);
  meter.look(2.0, start + 1100ms);
  EXPECT_DOUBLE_EQ(meter.motorRate(), 1000.0);
  EXPECT_DOUBLE_EQ(meter.realTimeFactor(), 1.0);
}

TEST(PlaybackClock, DueTimesFollowTheSpeedAndGiveUpWhenFarBehind) {
  using namespace std::chrono_literals;
  PlaybackClock pacer;
  const PlaybackClock::Clock::time_point start{};
  EXPECT_EQ(pacer.due(10.0, 2.0, start), start);
  EXPECT_EQ(pacer.due(10.5, 2.0, start), start + 250ms);
  EXPECT_EQ(pacer.due(11.0, 2.0, start + 600ms), start + 500ms);
  EXPECT_EQ(pacer.due(11.0, 2.0, start + 900ms), start + 900ms);
  EXPECT_EQ(pacer.due(12.0, 2.0, start + 900ms), start + 1400ms);
}

}  // namespace
}  // namespace capstan::live
