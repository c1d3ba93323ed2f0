#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/vision/hsv_threshold.h"
#include "core/vision/marker_detector.h"
#include "tests/support/disc_image.h"
#include "tests/support/plain_marker.h"

namespace capstan::vision {
namespace {

using capstan::testing::PlainMarker;

MarkerOptions hue(int low, int high, int saturation, int value) {
  MarkerOptions options;
  options.hue_low = low;
  options.hue_high = high;
  options.saturation_low = saturation;
  options.value_low = value;
  return options;
}

/// Ranges that touch one sector, several, wrap around hue 0, are inverted inside a sector, or are everything.
const std::vector<MarkerOptions>& ranges() {
  static const std::vector<MarkerOptions> all{
      hue(45, 85, 90, 40),   hue(0, 179, 0, 0),     hue(170, 10, 100, 50),  hue(10, 170, 1, 1),
      hue(80, 50, 60, 30),   hue(0, 0, 30, 0),      hue(179, 179, 200, 90), hue(30, 90, 255, 1),
      hue(100, 130, 50, 20), hue(28, 33, 120, 255), hue(179, 0, 10, 10),    hue(60, 60, 0, 128),
      hue(150, 150, 1, 1),   hue(20, 160, 40, 0),   hue(86, 85, 77, 77)};
  return all;
}

TEST(HsvThreshold, AgreesWithOpenCvOnEveryColour) {
  cv::Mat colours(4096, 4096, CV_8UC3);
  for (int i = 0; i < 1 << 24; ++i)
    colours.at<cv::Vec3b>(i >> 12, i & 4095) = cv::Vec3b(
        static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), static_cast<std::uint8_t>(i >> 16));
  cv::Mat hsv, expected, second;
  cv::cvtColor(colours, hsv, cv::COLOR_BGR2HSV);
  BitImage mask(4096, 4096);
  const auto differing = [&] {
    int count = 0;
    for (int y = 0; y < 4096; ++y)
      for (int x = 0; x < 4096; ++x) count += mask.at(x, y) != (expected.at<std::uint8_t>(y, x) != 0);
    return count;
  };
  for (const MarkerOptions& options : ranges()) {
    const cv::Scalar top(options.hue_high, 255, 255);
    if (options.hue_low <= options.hue_high) {
      cv::inRange(hsv, cv::Scalar(options.hue_low, options.saturation_low, options.value_low), top, expected);
    } else {
      cv::inRange(hsv, cv::Scalar(options.hue_low, options.saturation_low, options.value_low),
                  cv::Scalar(179, 255, 255), expected);
      cv::inRange(hsv, cv::Scalar(0, options.saturation_low, options.value_low), top, second);
      expected |= second;
    }
    HsvThreshold(options).apply(colours, mask);
    EXPECT_EQ(differing(), 0) << "hue " << options.hue_low << "–" << options.hue_high;
  }
  HsvThreshold(ranges().back()).applyPortable(colours, mask);
  EXPECT_EQ(differing(), 0) << "without vector instructions";
}

/// Random picture whose mask has large and small structure: noise, coarse blocks of the marker's colour, or
/// both.
cv::Mat randomPicture(int width, int height, double fill, int block, base::Random& random) {
  cv::Mat image(height, width, CV_8UC3);
  const int columns = (width + block - 1) / block;
  std::vector<bool> green(static_cast<std::size_t>(columns) * ((height + block - 1) / block));
  for (std::size_t i = 0; i < green.size(); ++i) green[i] = random.uniform(0.0, 1.0) < fill;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool on =
          green[static_cast<std::size_t>(y / block) * columns + x / block] != (random.uniform(0, 1) < 0.1);
      image.at<cv::Vec3b>(y, x) = on ? cv::Vec3b(60, static_cast<std::uint8_t>(random.uniform(150, 255)), 70)
                                     : cv::Vec3b(static_cast<std::uint8_t>(random.bits()), 90,
                                                 static_cast<std::uint8_t>(random.bits()));
    }
  return image;
}

void expectSameMask(const cv::Mat& image, const MarkerOptions& options, MarkerDetector& detector,
                    PlainMarker& plain) {
  detector.detect(image);
  const cv::Mat mine = detector.mask();
  const cv::Mat& expected = plain.clean(image, options);
  ASSERT_EQ(mine.size(), expected.size());
  EXPECT_EQ(cv::norm(mine, expected, cv::NORM_L1), 0.0) << image.cols << " x " << image.rows;
}

TEST(MarkerMask, EqualsOpenCvOnRandomPicturesOfEverySize) {
  base::Random random(1);
  const MarkerOptions options;
  MarkerDetector detector(options, 640, 480);
  PlainMarker plain;
  for (const auto& [width, height] : {std::pair{640, 480},
                                      {100, 100},
                                      {64, 64},
                                      {63, 31},
                                      {65, 7},
                                      {128, 5},
                                      {129, 9},
                                      {192, 3},
                                      {31, 40},
                                      {33, 40},
                                      {5, 5},
                                      {3, 8},
                                      {1, 6},
                                      {257, 20},
                                      {320, 2},
                                      {7, 1}})
    for (const double fill : {0.05, 0.5, 0.95})
      for (const int block : {1, 4, 9})
        expectSameMask(randomPicture(width, height, fill, block, random), options, detector, plain);
}

TEST(MarkerMask, EqualsOpenCvOnRenderedDiscsWithMarkerAtBorders) {
  base::Random random(2);
  const MarkerOptions options;
  MarkerDetector detector(options, 160, 120);
  PlainMarker plain;
  for (int i = 0; i < 40; ++i) {
    testing::DiscScene scene;
    scene.centre = {random.uniform(-5, 165), random.uniform(-5, 125)};
    scene.radius = random.uniform(2, 20);
    scene.noise = random.uniform(0, 20);
    expectSameMask(testing::renderDisc(scene, random), options, detector, plain);
  }
}

TEST(MarkerMask, RegionOfInterestIsJudgedByItsOwnPixelsAlone) {
  base::Random random(3);
  const MarkerOptions options;
  MarkerDetector detector(options, 640, 480);
  PlainMarker plain;
  const cv::Mat frame = randomPicture(640, 480, 0.5, 7, random);
  for (const cv::Rect roi :
       {cv::Rect(0, 0, 100, 100), cv::Rect(540, 380, 100, 100), cv::Rect(211, 97, 100, 100)}) {
    detector.detect(frame, roi);
    EXPECT_EQ(cv::norm(detector.mask(), plain.clean(frame(roi), options), cv::NORM_L1), 0.0);
  }
}

}  // namespace
}  // namespace capstan::vision
