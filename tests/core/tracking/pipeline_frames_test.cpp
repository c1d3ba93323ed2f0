#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/simulation/truth.h"
#include "tests/core/tracking/pipeline_scene.h"
#include "tests/support/counting_malloc.h"
#include "tests/support/counting_new.h"

namespace capstan::tracking {
namespace {

using simulation::SimulatedSource;
using test::simulated;

TEST(PipelineFrames, RenderedFramesGiveJointAngles) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 3.0, true));
  TrackingPipeline pipeline = makePipeline(source.info());
  const TrackReport report = trackAll(source, pipeline);
  EXPECT_GT(report.frames, 40u);
  EXPECT_GT(report.detectionRate(0), 0.99);
  EXPECT_GT(report.detectionRate(1), 0.99);
  EXPECT_GT(report.gateShare(Gate::kOpen), 0.95);
  EXPECT_LT(base::toDegrees(report.errors.camera().value()(1)), 1.0);
  EXPECT_LT(base::toMillimetres(report.errors.camera().value()(2)), 2.0);
}

TEST(PipelineFrames, BeforeRegistrationTheWholeFrameIsSearchedAndKinematicsRuns) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 3.0, true));
  tracking::SourceInfo info = source.info();
  info.base_from_camera.reset();
  TrackingPipeline pipeline = makePipeline(info);
  int frames = 0;
  trackAll(source, pipeline, nullptr, 0.0, [&](const Sample&, const Snapshot& s) {
    if (!s.camera_updated) return;
    ++frames;
    EXPECT_EQ(s.gate, Gate::kUnregistered);
    EXPECT_TRUE(s.marker[0].full_frame);
    const Eigen::Vector3d truth = source.trueBaseFromCamera().inverse() * source.frameTruth().tip;
    EXPECT_LT((s.tip_in_camera - truth).norm(), 0.02);
  });
  EXPECT_GT(frames, 10);
  EXPECT_LT((pipeline.snapshot().q_link_ukf - pipeline.snapshot().q_link_true).head<2>().norm(), 0.01);
}

TEST(PipelineFrames, EachCoveredCameraIsNamed) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 4.0, true));
  TrackingPipeline pipeline = makePipeline(source.info());
  std::array<int, 3> lost{};
  Sample sample;
  while (source.next(sample)) {
    const Snapshot& s = pipeline.step(sample);
    source.block((s.t > 1.0 && s.t < 2.0) || s.t > 3.0, s.t > 2.0);
    if (!s.camera_updated) continue;
    if (s.t_cam > 1.1 && s.t_cam < 1.9) lost[0] += s.gate == Gate::kLeftLost;
    if (s.t_cam > 2.1 && s.t_cam < 2.9) lost[1] += s.gate == Gate::kRightLost;
    if (s.t_cam > 3.1) lost[2] += s.gate == Gate::kBothLost;
  }
  for (const int count : lost) EXPECT_GE(count, 10);
}

TEST(PipelineFrames, ExchangedCamerasAreNamed) {
  for (const bool registered : {true, false}) {
    SimulatedSource source(simulated(simulation::matchedTruth(), 4.0, true));
    SourceInfo info = source.info();
    if (!registered) info.base_from_camera.reset();
    TrackingPipeline pipeline = makePipeline(info);
    int exchanged = 0, named = 0, named_wrongly = 0, after = 0;
    for (Sample sample; source.next(sample);) {
      auto* frame = std::get_if<StereoFrame>(&sample);
      const bool now = frame && frame->t > 1.0 && frame->t < 3.0;
      if (now) std::swap(frame->left, frame->right);
      const Snapshot& s = pipeline.step(sample);
      if (!s.camera_updated) continue;
      exchanged += now;
      (now ? named : named_wrongly) += s.gate == Gate::kExchanged;
      if (s.t_cam > 3.2) after += s.gate == (registered ? Gate::kOpen : Gate::kUnregistered);
    }
    EXPECT_GE(exchanged, 25);
    EXPECT_EQ(named, exchanged) << registered;
    EXPECT_EQ(named_wrongly, 0) << registered;
    EXPECT_GE(after, 8) << registered;
  }
}

TEST(PipelineFrames, ImagesOfAnotherSizeOrFormatAreNamedAndNotSearched) {
  SimulatedSource source(simulated(simulation::matchedTruth(), 2.0, true));
  TrackingPipeline pipeline = makePipeline(source.info());
  Sample sample;
  int frames = 0;
  while (source.next(sample)) {
    if (auto* frame = std::get_if<StereoFrame>(&sample)) {
      frame->left = cv::Mat(1080, 1920, CV_8UC3, cv::Scalar(60, 200, 60));
      frame->right = frames % 2 == 0 ? cv::Mat(240, 320, CV_8UC3, cv::Scalar(60, 200, 60))
                                     : cv::Mat(480, 640, CV_8UC1, cv::Scalar(60));
      ++frames;
    }
    const Snapshot& s = pipeline.step(sample);
    if (!s.camera_updated) continue;
    EXPECT_EQ(s.gate, Gate::kBothLost);
    EXPECT_EQ(s.marker[0].fault, vision::MarkerFault::kWrongImage);
    EXPECT_EQ(s.marker[1].fault, vision::MarkerFault::kWrongImage);
  }
  EXPECT_GT(frames, 5);
}

TEST(PipelineFrames, NothingIsAllocatedOnceWarm) {
  SimulatedSource source(simulated(simulation::defaultTruth(), 3.0, true));
  TrackingPipeline pipeline = makePipeline(source.info());
  std::size_t news = 0, mallocs = 0;
  int frames = 0;
  bool blocked = false;
  Sample sample;
  while (source.next(sample)) {
    const std::size_t new_before = capstan::test::allocations(), malloc_before = capstan::test::mallocs();
    const Snapshot& s = pipeline.step(sample);
    if (s.t > 0.5) {
      news += capstan::test::allocations() - new_before;
      mallocs += capstan::test::mallocs() - malloc_before;
      frames += s.camera_updated;
    }
    if ((s.t > 1.5) != blocked && s.t < 2.5) source.block(blocked = !blocked, false);
    if (s.t > 2.5 && blocked) source.block(blocked = false, false);
  }
  EXPECT_GT(frames, 30);
  EXPECT_EQ(news, 0u);
  EXPECT_EQ(mallocs, 0u);
}

}  // namespace
}  // namespace capstan::tracking
