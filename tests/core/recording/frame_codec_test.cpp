#include "core/recording/frame_codec.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/recording/session_samples.h"

namespace capstan::recording {
namespace {

using namespace testing;

void expectExact(const cv::Mat& image) {
  FrameEncoder encoder(image.cols, image.rows);
  FrameDecoder decoder(encoder.parameters(), "test");
  cv::Mat back;
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto packet = encoder.encode(image);
    ASSERT_TRUE(decoder.decode(packet, back));
    ASSERT_TRUE(sameBits(image, back)) << image.cols << "x" << image.rows;
  }
}

TEST(FrameCodec, BitExactOnNoiseGradientsAndPlainColour) {
  base::Random random(1);
  expectExact(noisyImage(random, 640, 480));
  expectExact(cv::Mat(480, 640, CV_8UC3, cv::Scalar(0, 255, 128)));
  cv::Mat gradient(480, 640, CV_8UC3);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x)
      gradient.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                                      static_cast<std::uint8_t>(x + y)};
  expectExact(gradient);
}

TEST(FrameCodec, BitExactAtOddSizes) {
  base::Random random(2);
  for (const auto& [width, height] : {std::pair{2, 2}, {3, 5}, {641, 479}, {643, 481}, {37, 2}, {638, 477}})
    expectExact(noisyImage(random, width, height));
}

TEST(FrameCodec, EachPacketStandsAlone) {
  base::Random random(3);
  FrameEncoder encoder(64, 48);
  std::vector<cv::Mat> images;
  std::vector<std::vector<std::uint8_t>> packets;
  for (int i = 0; i < 8; ++i) {
    images.push_back(noisyImage(random));
    const auto packet = encoder.encode(images.back());
    packets.emplace_back(packet.begin(), packet.end());
  }
  FrameDecoder decoder(encoder.parameters(), "test");
  cv::Mat back;
  for (const std::size_t i : {7U, 2U, 5U, 0U}) {
    ASSERT_TRUE(decoder.decode(packets[i], back));
    EXPECT_TRUE(sameBits(images[i], back));
  }
}

TEST(FrameCodec, ADamagedPacketIsAnAnswer) {
  base::Random random(4);
  FrameEncoder encoder(64, 48);
  const auto packet = encoder.encode(noisyImage(random));
  FrameDecoder decoder(encoder.parameters(), "test");
  cv::Mat back;
  EXPECT_FALSE(decoder.decode(packet.first(packet.size() / 3), back));
  EXPECT_FALSE(decoder.decode({}, back));
}

TEST(FrameCodec, AnUnknownCodecNamesItself) {
  try {
    FrameDecoder decoder({"no-such-codec", 64, 48, {}, 0}, "x.capstan");
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_EQ(error.fault().file, "x.capstan");
    EXPECT_EQ(error.fault().value, "no-such-codec");
    EXPECT_FALSE(error.fault().remedy.empty());
  }
}

}  // namespace
}  // namespace capstan::recording
