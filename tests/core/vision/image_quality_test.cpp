#include "core/vision/image_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "core/vision/image_correction.h"
#include "tests/support/folders.h"

namespace capstan::vision {
namespace {

/// A disc on a grey ground whose edge is blurred by `sigma` px: its level is the Gaussian integral of the
/// distance from the edge. Noise of `noise` levels.
cv::Mat blurredDisc(double sigma, double noise, double contrast = 120.0, double radius = 60.0) {
  base::Random random(4);
  cv::Mat image(200, 200, CV_8UC3);
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.cols; ++column) {
      const double outside = std::hypot(column - 99.3, row - 100.4) - radius;
      const double share = 0.5 * std::erfc(outside / (std::sqrt(2.0) * sigma));
      const double level = 60.0 + contrast * share + random.normal(0.0, noise);
      image.at<cv::Vec3b>(row, column) = cv::Vec3b::all(cv::saturate_cast<uchar>(level));
    }
  return image;
}

TEST(EdgeBlur, IsTheWidthOfTheEdgeWhateverItsContrast) {
  for (const double sigma : {0.7, 1.0, 1.5, 2.0, 3.0, 4.0})
    for (const double contrast : {50.0, 120.0, 190.0})
      EXPECT_NEAR(edgeBlur(blurredDisc(sigma, 0.0, contrast)), sigma, 0.12 + 0.05 * sigma)
          << sigma << " px, contrast " << contrast;
}

TEST(EdgeBlur, HoldsWithTheNoiseOfACamera) {
  for (const double sigma : {0.8, 2.0, 3.0})
    EXPECT_NEAR(edgeBlur(blurredDisc(sigma, 3.0)), sigma, 0.2 + 0.08 * sigma) << sigma;
}

TEST(EdgeBlur, AnImageWithoutEdgesHasNone) {
  EXPECT_TRUE(std::isnan(edgeBlur(cv::Mat(100, 100, CV_8UC3, cv::Scalar::all(80)))));
  EXPECT_TRUE(std::isnan(edgeBlur(cv::Mat())));
}

/// Cameras of a da Vinci, focused by their makers.
TEST(EdgeBlur, RealImagesAreInFocus) {
  const auto folder = test::dataFolder() / "davinci-red-marker";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const char* name : {"left01.jpg", "left05.jpg", "right03.jpg"}) {
    const cv::Mat image = cv::imread((folder / name).string());
    ASSERT_FALSE(image.empty());
    const double blur = edgeBlur(image);
    RecordProperty(name, std::to_string(blur));
    EXPECT_LT(blur, kLargestBlur) << name;
    cv::Mat soft;
    cv::GaussianBlur(image, soft, {}, 3.0);  // variances add
    EXPECT_NEAR(edgeBlur(soft), std::hypot(blur, 3.0), 0.5) << name;
  }
}

TEST(Exposure, CountsLevelsInsideTheCircle) {
  cv::Mat image(100, 100, CV_8UC3, cv::Scalar(10, 20, 30));
  image(cv::Rect(0, 0, 100, 20)).setTo(cv::Scalar(0, 255, 0));
  const Exposure whole = exposureOf(image);
  EXPECT_DOUBLE_EQ(whole.clipped, 0.2);
  EXPECT_DOUBLE_EQ(whole.median, 30.0);
  EXPECT_DOUBLE_EQ(whole.bright, 255.0);
  EXPECT_DOUBLE_EQ(whole.histogram[30 / 4], 0.8);
  EXPECT_DOUBLE_EQ(whole.histogram[63], 0.2);
  const Exposure circle = exposureOf(image, {50.0, 60.0, 20.0});
  EXPECT_DOUBLE_EQ(circle.clipped, 0.0);
  EXPECT_DOUBLE_EQ(circle.bright, 30.0);
}

/// Two images with a different colour in every pixel.
std::array<cv::Mat, 2> numbered() {
  std::array<cv::Mat, 2> images;
  for (int side = 0; side < 2; ++side) {
    images[static_cast<std::size_t>(side)] = cv::Mat(3, 5, CV_8UC3);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 5; ++column)
        images[static_cast<std::size_t>(side)].at<cv::Vec3b>(row, column) = {
            static_cast<uchar>(side), static_cast<uchar>(row), static_cast<uchar>(column)};
  }
  return images;
}

TEST(ImageCorrection, OfPixelsIsThatOfImages) {
  for (int bits = 0; bits < 32; ++bits) {
    const auto bit = [bits](int which) { return ((bits >> which) & 1) != 0; };
    const ImageCorrection correction{bit(0), {bit(1), bit(2)}, {bit(3), bit(4)}};
    auto [left, right] = numbered();
    correction.apply(left, right);
    const auto pixels = correction.apply({1.0, 0.0}, {4.0, 2.0}, 5, 3);
    const cv::Vec3b found[] = {
        left.at<cv::Vec3b>(static_cast<int>(pixels[0].y()), static_cast<int>(pixels[0].x())),
        right.at<cv::Vec3b>(static_cast<int>(pixels[1].y()), static_cast<int>(pixels[1].x()))};
    const cv::Vec3b of_left(0, 0, 1), of_right(1, 2, 4);
    EXPECT_EQ(found[0], correction.exchange ? of_right : of_left) << correction.words();
    EXPECT_EQ(found[1], correction.exchange ? of_left : of_right) << correction.words();
  }
}

TEST(ImageCorrection, ThenIsOneAfterTheOther) {
  for (int bits = 0; bits < 1024; ++bits) {
    const auto bit = [bits](int which) { return ((bits >> which) & 1) != 0; };
    const ImageCorrection first{bit(0), {bit(1), bit(2)}, {bit(3), bit(4)}};
    const ImageCorrection second{bit(5), {bit(6), bit(7)}, {bit(8), bit(9)}};
    const auto between = first.apply({1.0, 0.0}, {4.0, 2.0}, 5, 3);
    EXPECT_EQ(second.apply(between[0], between[1], 5, 3),
              first.then(second).apply({1.0, 0.0}, {4.0, 2.0}, 5, 3));
  }
}

TEST(ImageCorrection, SaysWhatItDoes) {
  EXPECT_EQ(ImageCorrection{}.words(), "");
  EXPECT_EQ((ImageCorrection{true, {true, true}, {}}.words()), "cameras exchanged, both images mirrored");
  EXPECT_EQ((ImageCorrection{false, {false, true}, {true, false}}.words()),
            "right image mirrored, left image upside down");
}

}  // namespace
}  // namespace capstan::vision
