#include "core/vision/marker_detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/counting_new.h"
#include "tests/support/disc_image.h"
#include "tests/support/plain_marker.h"

namespace capstan::vision {
namespace {

using testing::DiscScene;
using testing::renderDisc;

struct Errors {
  double mean = 0.0, contour_mean = 0.0, largest = 0.0, nees = 0.0;
};

Errors errorsOver(DiscScene scene, int trials, std::uint64_t seed) {
  base::Random random(seed);
  const MarkerOptions options;
  MarkerDetector detector(options, scene.width, scene.height);
  Errors errors;
  for (int i = 0; i < trials; ++i) {
    scene.centre = {random.uniform(70, 90), random.uniform(50, 70)};
    scene.radius = random.uniform(7, 13);
    const MarkerDetection found = detector.detect(renderDisc(scene, random));
    EXPECT_TRUE(found.found()) << base::nameOf(found.fault);
    const double error = (found.centroid - scene.centre).norm();
    errors.mean += error / trials;
    errors.largest = std::max(errors.largest, error);
    errors.contour_mean += (found.contour_centroid - scene.centre).norm() / trials;
    errors.nees += error * error / (found.sigma * found.sigma) / trials;
    EXPECT_NEAR(found.radius, scene.radius, 0.6);
  }
  return errors;
}

TEST(MarkerDetector, FlatDiscIsFoundToAFewHundredthsOfAPixel) {
  DiscScene scene;
  scene.shading = 0.0;
  const Errors errors = errorsOver(scene, 60, 1);
  EXPECT_LT(errors.mean, 0.03);
  EXPECT_LT(errors.largest, 0.08);
}

TEST(MarkerDetector, ShadedBallIsFoundBetterThanByItsContour) {
  for (const double shading : {0.3, 0.6}) {
    DiscScene scene;
    scene.shading = shading;
    const Errors errors = errorsOver(scene, 60, 2);
    EXPECT_LT(errors.mean, 0.07) << shading;
    EXPECT_LT(errors.mean, 0.5 * errors.contour_mean) << shading;
    EXPECT_LT(errors.nees, 2.0 * 2.0) << "sigma must not promise more than twice what is there";
    EXPECT_GT(errors.nees, 0.1) << "nor hide what is";
  }
}

TEST(MarkerDetector, ContourCentroidIsOpenCvs) {
  base::Random random(3);
  const MarkerOptions options;
  MarkerDetector detector(options, 160, 120);
  testing::PlainMarker plain;
  for (int i = 0; i < 40; ++i) {
    DiscScene scene;
    scene.centre = {random.uniform(30, 130), random.uniform(30, 90)};
    scene.noise = random.uniform(0, 8);
    cv::Mat image = renderDisc(scene, random);
    if (i % 2 == 0)  // a highlight makes a hole in the mask, which the contour closes
      cv::circle(image, cv::Point(scene.centre.x() - 3, scene.centre.y() - 3), 2, cv::Scalar(255, 255, 255),
                 -1);
    const auto expected = plain.detect(image, options);
    ASSERT_TRUE(expected);
    EXPECT_LT((detector.detect(image).contour_centroid - *expected).norm(), 1e-9);
  }
}

TEST(MarkerDetector, BorderCutsTheCircleNotItsCentre) {
  base::Random random(4);
  MarkerDetector detector(MarkerOptions{}, 160, 120);
  const Eigen::Vector2d centres[] = {{4.3, 60.2}, {155.1, 50.4}, {80.3, 3.2}, {5.5, 114.1}};
  for (const Eigen::Vector2d& centre : centres) {
    DiscScene scene;
    scene.centre = centre;
    scene.shading = 0.2;
    const MarkerDetection found = detector.detect(renderDisc(scene, random));
    ASSERT_TRUE(found.found()) << centre.transpose() << ": " << base::nameOf(found.fault);
    EXPECT_LT((found.centroid - centre).norm(), 0.25) << centre.transpose();
    EXPECT_GT((found.contour_centroid - centre).norm(), 1.0);
  }
}

TEST(MarkerDetector, RegionThatCutsTheCircleAgreesWithTheWholeFrame) {
  base::Random random(5);
  MarkerDetector detector(MarkerOptions{}, 160, 120);
  const DiscScene scene;
  const cv::Mat image = renderDisc(scene, random);
  const Eigen::Vector2d whole = detector.detect(image).centroid;
  const MarkerDetection cut = detector.detect(image, cv::Rect(0, 0, 78, 120));
  ASSERT_TRUE(cut.found());
  EXPECT_LT((cut.centroid - whole).norm(), 0.02);
  EXPECT_FALSE(cut.full_frame);
  EXPECT_EQ(cut.roi, (std::array{0, 0, 78, 120}));
}

TEST(MarkerDetector, ShaftOverTheEdgeDoesNotPullTheCentre) {
  base::Random random(6);
  MarkerDetector detector(MarkerOptions{}, 160, 120);
  DiscScene scene;
  scene.shading = 0.2;
  cv::Mat image = renderDisc(scene, random);
  cv::rectangle(image, cv::Rect(76, 10, 9, 45), cv::Scalar(70, 70, 72), -1);  // six pixels into the disc
  const MarkerDetection found = detector.detect(image);
  ASSERT_TRUE(found.found());
  EXPECT_LT((found.centroid - scene.centre).norm(), 0.12);
  EXPECT_GT((found.contour_centroid - scene.centre).norm(), 0.5);
}

TEST(MarkerDetector, RedMarkerAcrossHueZero) {
  base::Random random(7);
  MarkerOptions options;
  options.hue_low = 170;
  options.hue_high = 10;
  MarkerDetector detector(options, 160, 120);
  const Eigen::Vector3d colours[] = {{70, 50, 200}, {50, 70, 200}};
  for (const Eigen::Vector3d& colour : colours) {
    DiscScene scene;
    scene.colour = colour;
    scene.shading = 0.3;
    const MarkerDetection found = detector.detect(renderDisc(scene, random));
    ASSERT_TRUE(found.found());
    EXPECT_LT((found.centroid - scene.centre).norm(), 0.1);
  }
}

TEST(MarkerDetector, SaysWhyNothingWasFound) {
  base::Random random(8);
  MarkerOptions options;
  MarkerDetector detector(options, 160, 120);
  DiscScene empty;
  empty.radius = 0.0;
  const cv::Mat background = renderDisc(empty, random);
  const cv::Scalar green(60, 200, 70);
  EXPECT_EQ(detector.detect(cv::Mat()).fault, MarkerFault::kNoImage);
  EXPECT_EQ(detector.detect(background, cv::Rect(300, 300, 100, 100)).fault, MarkerFault::kNoImage);
  EXPECT_EQ(detector.detect(background).fault, MarkerFault::kNoPixels);

  cv::Mat image = background.clone();
  cv::circle(image, {80, 60}, 2, green, -1);
  EXPECT_EQ(detector.detect(image).fault, MarkerFault::kTooSmall);

  image = background.clone();
  cv::rectangle(image, cv::Rect(40, 55, 60, 9), green, -1);
  EXPECT_EQ(detector.detect(image).fault, MarkerFault::kNotRound);

  image = background.clone();
  cv::circle(image, {50, 60}, 11, green, -1);
  cv::circle(image, {110, 60}, 10, green, -1);
  EXPECT_EQ(detector.detect(image).fault, MarkerFault::kTwoCandidates);

  image = background.clone();
  cv::circle(image, {50, 60}, 11, green, -1);
  cv::circle(image, {110, 60}, 5, green, -1);
  EXPECT_EQ(detector.detect(image).fault, MarkerFault::kNone);

  image = background.clone();
  cv::rectangle(image, cv::Rect(0, 0, 160, 30), green, -1);  // a green cloth at the border is no arc
  EXPECT_EQ(detector.detect(image).fault, MarkerFault::kNotRound);
}

TEST(MarkerDetector, AllocatesNothing) {
  base::Random random(9);
  MarkerDetector detector(MarkerOptions{}, 160, 120);
  DiscScene scene;
  scene.noise = 30.0;
  const cv::Mat clean = renderDisc(DiscScene{}, random), noisy = renderDisc(scene, random);
  detector.detect(clean);
  const std::size_t before = test::allocations();
  for (const cv::Mat& image : {clean, noisy}) {
    detector.detect(image);
    detector.detect(image, cv::Rect(30, 10, 100, 100));
  }
  EXPECT_EQ(test::allocations(), before);
}

TEST(MarkerDetector, AnImageLargerThanPromisedOrOfAnotherFormatIsRefused) {
  MarkerDetector detector(MarkerOptions{}, 160, 120);
  const cv::Mat large(480, 640, CV_8UC3, cv::Scalar(60, 200, 60)), grey(120, 160, CV_8UC1, cv::Scalar(60));
  EXPECT_EQ(detector.detect(large).fault, MarkerFault::kWrongImage);
  EXPECT_EQ(detector.detect(grey).fault, MarkerFault::kWrongImage);
  EXPECT_EQ(detector.detect(large, cv::Rect(0, 0, 161, 20)).fault, MarkerFault::kWrongImage);
  EXPECT_NE(detector.detect(large, cv::Rect(300, 200, 100, 100)).fault, MarkerFault::kWrongImage);
}

TEST(RoiAround, StaysInsideTheFrameAndKeepsItsSize) {
  const MarkerOptions options;
  const cv::Size frame(640, 480);
  EXPECT_EQ(roiAround({320.2, 240.4}, options, frame), cv::Rect(270, 190, 100, 100));
  EXPECT_EQ(roiAround({3.0, 470.0}, options, frame), cv::Rect(0, 380, 100, 100));
  EXPECT_EQ(roiAround({-30.0, 100.0}, options, frame), cv::Rect(0, 50, 100, 100));
  EXPECT_TRUE(roiAround({-80.0, 100.0}, options, frame).empty());
  EXPECT_TRUE(roiAround({std::nan(""), 100.0}, options, frame).empty());
  EXPECT_EQ(roiAround({30.0, 30.0}, options, cv::Size(64, 48)), cv::Rect(0, 0, 64, 48));
}

}  // namespace
}  // namespace capstan::vision
