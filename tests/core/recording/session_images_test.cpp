#include "core/recording/session_images.h"

#include <gtest/gtest.h>

#include "core/recording/recorder.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

/// Motors at 100 Hz with a pair of images at every seventh sample.
std::vector<tracking::StereoFrame> record(const std::filesystem::path& path, int pairs) {
  base::Random random(1);
  RecorderOptions options;
  options.width = 64;
  options.height = 48;
  options.frame_rate = 400.0;
  Recorder recorder(path, header(), options);
  std::vector<tracking::StereoFrame> frames;
  for (int i = 0; i < 7 * pairs; ++i) {
    const double t = 0.01 * i;
    EXPECT_TRUE(recorder.offer(
        tracking::MotorSample{t, awkwardVector(random), awkwardVector(random), awkwardVector(random)}));
    if (i % 7 != 3) continue;
    frames.push_back({t, t + 0.03, noisyImage(random), noisyImage(random)});
    EXPECT_TRUE(recorder.offer(frames.back()));
  }
  recorder.setMarker(0.0, "hue_low: 3\n");
  return frames;
}

TEST(SessionImages, GiveTheNearestPairInAnyOrder) {
  const TemporaryFolder folder;
  const auto frames = record(folder / "a.capstan", 40);
  SessionImages images(folder / "a.capstan");
  base::Random random(2);
  tracking::StereoFrame seen;
  for (int i = 0; i < 100; ++i) {
    const double t = random.uniform(-0.1, 3.0);
    const auto nearest = std::ranges::min_element(
        frames, {}, [&](const tracking::StereoFrame& frame) { return std::abs(frame.t - t); });
    ASSERT_TRUE(images.at(t, 1.0, seen)) << t;
    EXPECT_EQ(seen.t, nearest->t);
    EXPECT_EQ(seen.t_arrival, nearest->t_arrival);
    EXPECT_TRUE(sameBits(seen.left, nearest->left));
    EXPECT_TRUE(sameBits(seen.right, nearest->right));
    EXPECT_EQ(images.at(t, 0.01, seen), std::abs(nearest->t - t) <= 0.01);
  }
}

TEST(SessionImages, ASessionWithoutImagesHasNone) {
  const TemporaryFolder folder;
  { Recorder recorder(folder / "a.capstan", header(), {}); }
  SessionImages images(folder / "a.capstan");
  tracking::StereoFrame seen;
  EXPECT_FALSE(images.at(1.0, 100.0, seen));
  EXPECT_THROW(SessionImages(folder / "none.capstan"), base::InputError);
}

TEST(SessionImages, AMarkerThatIsChosenWhileRecordingIsStored) {
  const TemporaryFolder folder;
  record(folder / "a.capstan", 2);
  EXPECT_EQ(readSessionSummary(folder / "a.capstan").header.marker, "hue_low: 3\n");
}

}  // namespace
}  // namespace capstan::recording
