// Images that were blocked deliberately: who marks them, and that a recording still knows of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/live/blocking.h"
#include "core/live/occluded_source.h"
#include "core/live/runner.h"
#include "core/recording/occlusion_events.h"
#include "core/recording/session_source.h"
#include "core/tracking/cover_frame.h"
#include "core/tracking/health.h"
#include "tests/core/tracking/pipeline_scene.h"
#include "tests/support/temporary_folder.h"

namespace capstan::tracking {
namespace {

using namespace tracking::test;

const live::OcclusionSchedule kSchedule{.percentage = 40.0, .interval = 1.0};

std::unique_ptr<simulation::SimulatedSource> fiveSeconds() {
  return std::make_unique<simulation::SimulatedSource>(simulated(simulation::matchedTruth(), 5.0, true));
}

void expectPass(const TrackReport& report) {
  const std::string value =
      fmt::format("100.0 % of {} images; 30 more were blocked deliberately", report.frames - 30U);
  int judged = 0;
  for (const HealthCheck& check : healthOf(report, robot::defaultDescription(), 0.25)) {
    if (!check.key.starts_with("detection_")) continue;
    EXPECT_EQ(check.verdict, HealthVerdict::kPass) << check.key << ": " << check.value << check.advice;
    EXPECT_EQ(check.value, value);
    ++judged;
  }
  EXPECT_EQ(judged, 2);
}

TEST(DeliberateOcclusion, IsNoFaultOfTheCameras) {
  const auto source = fiveSeconds();
  TrackingPipeline pipeline = makePipeline(source->info());
  live::OccludedSource occluded(*source, kSchedule);
  const TrackReport report = trackAll(occluded, pipeline);
  EXPECT_GE(report.frames, 75U);
  EXPECT_EQ(report.blocked[0], 30U);
  EXPECT_EQ(report.blocked[1], 30U);
  EXPECT_EQ(report.gates[static_cast<std::size_t>(Gate::kBothLost)], 30U);
  EXPECT_EQ(report.detectionRate(0), 1.0);
  expectPass(report);
}

TEST(DeliberateOcclusion, IsKnownFromARecording) {
  const capstan::test::TemporaryFolder folder;
  TrackReport live;
  {
    auto source = fiveSeconds();
    const SourceInfo info = source->info();
    live::RunnerOptions options;
    options.speed = 0.0;
    live::Runner runner(std::move(source), makePipeline(info), options);
    recording::RecorderOptions all;
    all.wait = true;
    runner.startRecording(folder / "a.capstan", recording::headerOf(info, "2026-11-29"), all);
    runner.setOcclusion(kSchedule);
    runner.run();
    ASSERT_TRUE(runner.waitUntilIdle(300.0));
    live = runner.report();
    runner.stopRecording();
  }
  ASSERT_EQ(live.blocked[0], 30U);
  recording::SessionSource source(folder / "a.capstan");
  TrackingPipeline pipeline = makePipeline(source.info());
  const TrackReport report = trackAll(source, pipeline);
  EXPECT_EQ(report.frames, live.frames);
  EXPECT_EQ(report.blocked, live.blocked);
  EXPECT_EQ(report.detected, live.detected);
  expectPass(report);
}

TEST(DeliberateOcclusion, IsAddedToThatOfTheRecording) {
  StereoFrame frame{0.0, 0.0, cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(99)), {}};
  frame.blocked = {false, true};
  coverFrame(frame, {true, false});
  EXPECT_TRUE(frame.blocked[0] && frame.blocked[1]);
  EXPECT_NE(frame.left.at<cv::Vec3b>(20, 20), cv::Vec3b(99, 99, 99));
}

TEST(DeliberateOcclusion, FollowsItsCameraWhenTheImagesAreExchanged) {
  live::Blocking blocking;
  blocking.setCorrection({.exchange = true, .mirror = {}, .flip = {}});
  StereoFrame frame;
  frame.blocked = {true, false};
  Sample sample = frame;
  blocking.correct(sample);
  EXPECT_EQ(std::get<StereoFrame>(sample).blocked, (std::array<bool, 2>{false, true}));
}

TEST(DeliberateOcclusion, EventsSayWhichCamerasAreBlocked) {
  using recording::occlusionText, recording::parseOcclusion;
  EXPECT_EQ(occlusionText({true, true}), "both blocked");
  EXPECT_EQ(occlusionText({false, true}, true), "right blocked, added to a recording");
  for (const bool left : {false, true})
    for (const bool added : {false, true}) {
      const auto event = parseOcclusion(occlusionText({left, false}, added));
      ASSERT_TRUE(event);
      EXPECT_EQ(event->blocked, (std::array<bool, 2>{left, false}));
      EXPECT_EQ(event->added, added);
    }
  EXPECT_FALSE(parseOcclusion(live::scheduleWords(kSchedule)));
  EXPECT_FALSE(parseOcclusion("left blocked by a hand"));
}

}  // namespace
}  // namespace capstan::tracking
