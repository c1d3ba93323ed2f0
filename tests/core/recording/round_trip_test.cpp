// What is recorded comes back to the last bit, in the order of arrival.
#include <gtest/gtest.h>

#include "core/recording/recorder.h"
#include "core/recording/session_source.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

std::vector<tracking::Sample> replay(const std::filesystem::path& path) {
  SessionSource source(path);
  std::vector<tracking::Sample> samples;
  for (tracking::Sample sample; source.next(sample);) {
    samples.push_back(sample);
    if (auto* frame = std::get_if<tracking::StereoFrame>(&samples.back())) {
      frame->left = frame->left.clone();
      frame->right = frame->right.clone();
    }
  }
  return samples;
}

RecorderOptions smallFrames() {
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  options.frame_rate = 400.0;
  return options;
}

TEST(RoundTrip, AllKindsOfSamplesToTheLastBit) {
  const TemporaryFolder folder;
  const auto samples = someSamples(1, 2000);
  {
    Recorder recorder(folder / "a.capstan", header(), smallFrames());
    for (const auto& sample : samples) ASSERT_TRUE(recorder.offer(sample));
    recorder.close();
    EXPECT_EQ(recorder.stats().written, samples.size());
    EXPECT_EQ(recorder.stats().dropped, 0U);
    EXPECT_EQ(recorder.stats().state, RecorderState::kClosed);
  }
  const auto back = replay(folder / "a.capstan");
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    ASSERT_TRUE(sameBits(samples[i], back[i])) << "sample " << i;
}

TEST(RoundTrip, FramesOfAnotherSizeThanExpected) {
  const TemporaryFolder folder;
  const auto samples = someSamples(2, 40, 101, 37);
  {
    Recorder recorder(folder / "a.capstan", header(), smallFrames());
    for (const auto& sample : samples) ASSERT_TRUE(recorder.offer(sample));
  }
  const auto back = replay(folder / "a.capstan");
  ASSERT_EQ(back.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_TRUE(sameBits(samples[i], back[i])) << "sample " << i;
}

TEST(RoundTrip, EstimatesAndEvents) {
  const TemporaryFolder folder;
  base::Random random(3);
  std::vector<tracking::Snapshot> snapshots;
  for (int i = 0; i < 200; ++i) snapshots.push_back(someSnapshot(random));
  {
    Recorder recorder(folder / "a.capstan", header(), smallFrames());
    for (const auto& snapshot : snapshots) ASSERT_TRUE(recorder.offer(snapshot));
    recorder.note(1.5, "note", "a \"word\", and µ");
    recorder.note(2.5, "occlusion", "both blocked");
  }
  const auto rows = readSessionEstimates(folder / "a.capstan");
  ASSERT_EQ(rows.size(), snapshots.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const EstimateRow expected = estimateOf(snapshots[i]);
    EXPECT_TRUE(sameBits(rows[i].t, expected.t) && sameBits(rows[i].t_cam, expected.t_cam));
    EXPECT_TRUE(sameBits(rows[i].q_link_kin, expected.q_link_kin));
    EXPECT_TRUE(sameBits(rows[i].q_link_cam, expected.q_link_cam));
    EXPECT_TRUE(sameBits(rows[i].q_link_cam_sigma, expected.q_link_cam_sigma));
    EXPECT_TRUE(sameBits(rows[i].q_link_ukf, expected.q_link_ukf));
    EXPECT_TRUE(sameBits(rows[i].dq_link_ukf, expected.dq_link_ukf));
    EXPECT_TRUE(sameBits(rows[i].q_link_ukf_sigma, expected.q_link_ukf_sigma));
    EXPECT_TRUE(sameBits(rows[i].q_link_true, expected.q_link_true));
    EXPECT_EQ(rows[i].gate, static_cast<int>(tracking::Gate::kJump));
    EXPECT_EQ(rows[i].camera_updated, expected.camera_updated);
    EXPECT_TRUE(sameBits(rows[i].nis, expected.nis) && sameBits(rows[i].nees, expected.nees));
  }
  const auto events = readSessionEvents(folder / "a.capstan");
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].t, 1.5);
  EXPECT_EQ(events[0].text, "a \"word\", and µ");
  EXPECT_EQ(events[1].kind, "occlusion");
}

TEST(RoundTrip, HeaderAndRegistration) {
  const TemporaryFolder folder;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translation() << 0.1, -1.0 / 3.0, 0.55;
  {
    Recorder recorder(folder / "a.capstan", header());
    recorder.offer(tracking::Sample(tracking::JointSample{5.0, {0, 0, 0}}));
    recorder.offer(tracking::Sample(tracking::JointSample{7.25, {0, 0, 0}}));
    recorder.setRegistration(3.0, pose);
  }
  const SessionSource source(folder / "a.capstan");
  ASSERT_TRUE(source.info().base_from_camera);
  EXPECT_EQ(source.info().base_from_camera->matrix(), pose.matrix());
  EXPECT_EQ(base::writeYaml(source.info().robot), header().robot);
  EXPECT_EQ(source.info().marker, header().marker);
  EXPECT_EQ(source.info().tracking, header().tracking);
  EXPECT_EQ(source.info().truth, header().truth);
  EXPECT_EQ(source.info().title, "a test");
  EXPECT_EQ(source.info().begin, 5.0);
  EXPECT_EQ(source.info().duration, 2.25);
  EXPECT_TRUE(source.info().reference);
  EXPECT_FALSE(source.info().live);
}

TEST(RoundTrip, ReadableWhileItIsRecorded) {
  const TemporaryFolder folder;
  Recorder recorder(folder / "a.capstan", header(), smallFrames());
  const auto samples = someSamples(4, 50);
  for (const auto& sample : samples) recorder.offer(sample);
  while (recorder.stats().written < samples.size())
    ASSERT_EQ(recorder.stats().state, RecorderState::kRecording);
  EXPECT_EQ(replay(folder / "a.capstan").size(), samples.size());
}

TEST(RoundTrip, BlockedCamerasSeeOpaquePixelsAndTipsVanish) {
  const TemporaryFolder folder;
  const auto samples = someSamples(5, 60);
  {
    Recorder recorder(folder / "a.capstan", header(), smallFrames());
    for (const auto& sample : samples) recorder.offer(sample);
  }
  SessionSource source(folder / "a.capstan");
  source.block(true, false);
  tracking::Sample sample;
  for (std::size_t i = 0; source.next(sample); ++i) {
    if (const auto* tip = std::get_if<tracking::TipSample>(&sample)) {
      EXPECT_TRUE(tip->position.array().isNaN().all());
    }
    const auto* frame = std::get_if<tracking::StereoFrame>(&sample);
    if (!frame) continue;
    const auto& seen = std::get<tracking::StereoFrame>(samples[i]);
    EXPECT_TRUE(sameBits(frame->right, seen.right));
    if (seen.left.empty()) continue;
    double brightest = 0.0;
    cv::minMaxLoc(frame->left.reshape(1), nullptr, &brightest);
    EXPECT_LT(brightest, 64.0) << "something of the noise shines through";
  }
}

}  // namespace
}  // namespace capstan::recording
