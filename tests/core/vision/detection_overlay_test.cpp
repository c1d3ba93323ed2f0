#include "core/vision/detection_overlay.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace capstan::vision {
namespace {

constexpr int kWidth = 640, kHeight = 480, kStrip = 40;

/// The lower strip of one side of an overlay on grey pictures, where the words are.
cv::Mat words(const cv::Mat& overlay, int side) {
  return overlay(cv::Rect(side * kWidth, kHeight - kStrip, kWidth, kStrip));
}

double differenceOf(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_L1); }

TEST(DetectionOverlay, NamesTheSidesWithAndWithoutAMarker) {
  const cv::Mat grey(kHeight, kWidth, CV_8UC3, cv::Scalar(128, 128, 128));
  const cv::Mat blank = words(grey, 0);
  MarkerDetection found, lost;
  found.fault = MarkerFault::kNone;
  found.centroid = {300.0, 200.0};
  found.radius = 11.0;
  lost.fault = MarkerFault::kNoPixels;
  const cv::Mat both = detectionOverlay({grey, grey}, {found, found});
  ASSERT_EQ(both.size(), cv::Size(2 * kWidth, kHeight));
  EXPECT_GT(differenceOf(words(both, 0), blank), 0.0);
  EXPECT_GT(differenceOf(words(both, 1), blank), 0.0);
  EXPECT_GT(differenceOf(words(both, 0), words(both, 1)), 0.0) << "left and right are two words";
  const cv::Mat one = detectionOverlay({grey, grey}, {found, lost});
  EXPECT_EQ(differenceOf(words(one, 0), words(both, 0)), 0.0);
  EXPECT_GT(differenceOf(words(one, 1), words(both, 1)), 0.0) << "the reason is beside the name";
}

}  // namespace
}  // namespace capstan::vision
