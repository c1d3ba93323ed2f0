#include "core/simulation/renderer.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/cover_image.h"
#include "core/vision/marker_detector.h"
#include "tests/core/simulation/simulated_robot.h"

namespace capstan::simulation {
namespace {

/// Camera at the origin of frame 0, looking along z.
CameraRenderer rendererOf(const ImageTruth& appearance, double exposure = 0.0, double radius = 0.005,
                          int side = 0, std::uint64_t seed = 1) {
  SceneSizes sizes;
  sizes.marker_radius = radius;
  return {testRig().left, Eigen::Isometry3d::Identity(), sizes, appearance, exposure, seed, side};
}

ToolPose toolAt(const Eigen::Vector3d& tip, const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) {
  return {tip, velocity, Eigen::Vector3d(0.1, -1.0, 0.3).normalized()};
}

cv::Mat greenMask(const cv::Mat& image) {
  const vision::MarkerOptions options;
  cv::Mat hsv, mask;
  cv::cvtColor(image, hsv, cv::COLOR_BGR2HSV);
  cv::inRange(hsv, cv::Scalar(options.hue_low, options.saturation_low, options.value_low),
              cv::Scalar(options.hue_high, 255, 255), mask);
  return mask;
}

/// By how much green exceeds the mean of red and blue, 0…255: about the share of the marker in a pixel.
cv::Mat greenness(const cv::Mat& image) {
  std::array<cv::Mat, 3> bgr;
  cv::split(image, bgr.data());
  cv::Mat other;
  cv::addWeighted(bgr[0], 0.5, bgr[2], 0.5, 0.0, other);
  return bgr[1] - other;
}

/// Unweighted centroid of the pixels that pass the detector's default threshold.
Eigen::Vector2d naiveCentroid(const cv::Mat& image, double* area = nullptr) {
  const cv::Moments m = cv::moments(greenMask(image), true);
  if (area != nullptr) *area = m.m00;
  return {m.m10 / m.m00, m.m01 / m.m00};
}

TEST(Outline, UndistortedEllipseCentreIsTheClosedForm) {
  // A sphere at (X, 0, Z) projects to an ellipse whose centre lies at X Z / (Z² − r²), not X / Z.
  vision::Camera camera = testRig().left;
  camera.distortion = {};
  SceneSizes sizes;
  sizes.marker_radius = 0.03;
  const CameraRenderer renderer(camera, Eigen::Isometry3d::Identity(), sizes, {}, 0.0, 1, 0);
  const Eigen::Vector3d centre(0.12, 0.0, 0.4);
  const RenderedMarker seen = renderer.outline(toolAt(centre));
  const double exact = centre.x() * centre.z() / (centre.z() * centre.z() - 0.03 * 0.03);
  EXPECT_NEAR(seen.sphere_centre.x(), camera.cx + camera.fx * centre.x() / centre.z(), 1e-9);
  EXPECT_NEAR(seen.ellipse_centre.x(), camera.cx + camera.fx * exact, 2e-3);
  EXPECT_NEAR(seen.ellipse_centre.y(), camera.cy, 1e-6);
  EXPECT_GT(seen.ellipse_centre.x() - seen.sphere_centre.x(), 1.0);
}

TEST(Outline, RenderedAreaAndCentroidAreThoseOfTheOutline) {
  CameraRenderer renderer = rendererOf({}, 0.0, 0.02);
  cv::Mat image;
  for (const Eigen::Vector3d& tip : {Eigen::Vector3d(0.0, 0.0, 0.5), Eigen::Vector3d(0.11, 0.06, 0.45),
                                     Eigen::Vector3d(-0.12, 0.08, 0.6)}) {
    renderer.render(toolAt(tip), image);
    const RenderedMarker truth = renderer.outline(toolAt(tip));
    double area = 0.0;
    const Eigen::Vector2d centroid = naiveCentroid(image, &area);
    EXPECT_LT((centroid - truth.ellipse_centre).norm(), 0.15) << tip.transpose();
    EXPECT_NEAR(std::sqrt(area / std::acos(-1.0)) / truth.radius, 1.0, 0.03);
  }
}

TEST(Outline, SaysWhenTheMarkerLeavesThePicture) {
  const CameraRenderer renderer = rendererOf({});
  EXPECT_TRUE(renderer.outline(toolAt({0.0, 0.0, 0.5})).in_view);
  EXPECT_FALSE(renderer.outline(toolAt({0.25, 0.0, 0.5})).in_view);
  EXPECT_FALSE(renderer.outline(toolAt({0.0, 0.0, -0.5})).in_view);
}

TEST(Renderer, NoisyMarkersAreFoundWithinAFifthOfAPixel) {
  CameraRenderer renderer = rendererOf(defaultTruth().images, 0.008);
  vision::MarkerDetector detector({}, 640, 480);
  base::Random random(3);
  cv::Mat image;
  double square = 0.0;
  constexpr int kFrames = 60;
  for (int i = 0; i < kFrames; ++i) {
    const ToolPose pose =
        toolAt({random.uniform(-0.1, 0.1), random.uniform(-0.03, 0.12), random.uniform(0.45, 0.55)},
               {random.normal(0.0, 0.05), random.normal(0.0, 0.05), random.normal(0.0, 0.05)});
    renderer.render(pose, image);
    const RenderedMarker truth = renderer.outline(pose);
    const vision::MarkerDetection found =
        detector.detect(image, vision::roiAround(truth.sphere_centre, detector.options(), image.size()));
    ASSERT_TRUE(found.found()) << base::nameOf(found.fault);
    square += (found.centroid - truth.ellipse_centre).squaredNorm();
  }
  EXPECT_LT(std::sqrt(square / kFrames), 0.2);
}

TEST(Renderer, MotionBlurWidensAlongTheMotionOnly) {
  CameraRenderer sharp = rendererOf({}, 0.0), blurred = rendererOf({}, 0.02);
  const Eigen::Vector3d tip(0.01, 0.05, 0.5), speed(0.3, 0.0, 0.0), up(0.0, -1.0, 0.0);
  cv::Mat a, b, c;
  sharp.render({tip, speed, up}, a);
  blurred.render({tip, Eigen::Vector3d::Zero(), up}, b);
  blurred.render({tip, speed, up}, c);
  const auto extent = [](const cv::Mat& image) {
    cv::Mat points;
    cv::findNonZero(greenness(image) > 2, points);
    return cv::boundingRect(points);
  };
  const auto column = [](const cv::Mat& image) {
    const cv::Moments m = cv::moments(greenness(image));
    return m.m10 / m.m00;
  };
  EXPECT_EQ(extent(a), extent(b));
  EXPECT_GE(extent(c).width, extent(a).width + 3);  // of 7.8 px, those that the marker fills long enough
  EXPECT_LE(extent(c).height, extent(a).height);    // the round ends are thinned out, nothing is added
  EXPECT_NEAR(column(c), column(a), 0.1);
}

TEST(Renderer, ColourNoiseHasItsSigma) {
  ImageTruth appearance;
  appearance.noise = 6.0;
  CameraRenderer noisy = rendererOf(appearance), clean = rendererOf({});
  cv::Mat a, b, difference;
  noisy.render(toolAt({0.0, 0.05, 0.5}), a);
  clean.render(toolAt({0.0, 0.05, 0.5}), b);
  cv::subtract(a, b, difference, cv::noArray(), CV_32F);
  cv::Scalar mean, sigma;
  cv::meanStdDev(difference, mean, sigma);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(mean[c], 0.0, 0.05);
    EXPECT_NEAR(sigma[c], 6.0, 0.1);
  }
}

TEST(Renderer, EachPartOfTheTruthShows) {
  cv::Mat plain, other;
  rendererOf({}).render(toolAt({0.0, 0.05, 0.5}), plain);
  const auto change = [&](const ImageTruth& appearance) {
    rendererOf(appearance).render(toolAt({0.0, 0.05, 0.5}), other);
    return cv::norm(plain, other, cv::NORM_L1) / static_cast<double>(3 * plain.total());
  };
  EXPECT_EQ(change({}), 0.0);
  ImageTruth appearance;
  appearance.unevenness = 0.8;
  EXPECT_GT(change(appearance), 10.0);
  cv::Mat light;
  cv::resize(other, light, {8, 6}, 0.0, 0.0, cv::INTER_AREA);
  double darkest = 0.0, brightest = 0.0;
  cv::minMaxLoc(light.reshape(1), &darkest, nullptr);
  cv::minMaxLoc(light.reshape(1), nullptr, &brightest);
  EXPECT_LT(darkest, 0.4 * brightest);
  appearance = {};
  appearance.texture = 1.0;
  EXPECT_GT(change(appearance), 3.0);
  appearance = {};
  appearance.exposure_noise = 0.05;
  EXPECT_GT(change(appearance), 0.2);
}

TEST(Renderer, DistractorsPassTheThresholdAtTheMarginsAndInBetween) {
  ImageTruth appearance;
  appearance.distractors = 6;
  CameraRenderer renderer = rendererOf(appearance);
  cv::Mat image, labels;
  renderer.render(toolAt({0.0, 0.05, 0.5}), image);
  const cv::Mat mask = greenMask(image);
  EXPECT_GE(cv::connectedComponents(mask, labels),
            5);  // background, marker, at least three that do not touch
  EXPECT_GT(cv::countNonZero(mask(cv::Rect(0, 0, 150, 480))), 100);
  EXPECT_GT(cv::countNonZero(mask(cv::Rect(490, 0, 150, 480))), 100);
  const cv::Mat middle = mask(cv::Rect(150, 0, 340, 480));
  appearance.distractors = 0;
  cv::Mat without;
  rendererOf(appearance).render(toolAt({0.0, 0.05, 0.5}), without);
  EXPECT_GT(cv::countNonZero(middle), cv::countNonZero(greenMask(without)) + 100);
  appearance.distractors = 6;
  appearance.distractor_hue = 60.0;  // blue: no longer of nearly the marker's colour
  cv::Mat blue;
  rendererOf(appearance).render(toolAt({0.0, 0.05, 0.5}), blue);
  EXPECT_EQ(cv::countNonZero(greenMask(blue)), cv::countNonZero(greenMask(without)));
}

TEST(Renderer, AShaftInFrontCoversTheMarker) {
  CameraRenderer renderer = rendererOf({});
  cv::Mat away, towards;
  ToolPose pose = toolAt({0.0, 0.0, 0.5});
  pose.axis = Eigen::Vector3d(0.0, -0.5, 0.9).normalized();
  renderer.render(pose, away);
  pose.axis = Eigen::Vector3d(0.0, -0.3, -0.95).normalized();
  renderer.render(pose, towards);
  EXPECT_LT(cv::countNonZero(greenMask(towards)), 0.8 * cv::countNonZero(greenMask(away)));
}

TEST(Renderer, SameSeedSameBytesOtherSeedOtherBytes) {
  const ImageTruth appearance = defaultTruth().images;
  CameraRenderer one = rendererOf(appearance, 0.008, 0.005, 0, 7),
                 again = rendererOf(appearance, 0.008, 0.005, 0, 7);
  CameraRenderer other = rendererOf(appearance, 0.008, 0.005, 0, 8);
  cv::Mat a, b, c;
  for (int i = 0; i < 3; ++i) {
    const ToolPose pose = toolAt({0.01 * i, 0.05, 0.5}, {0.1, 0.0, 0.0});
    one.render(pose, a);
    again.render(pose, b);
    other.render(pose, c);
    EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
    EXPECT_GT(cv::norm(a, c, cv::NORM_INF), 0.0);
  }
}

TEST(Renderer, ACoveredPictureShowsNoMarker) {
  CameraRenderer renderer = rendererOf(defaultTruth().images);
  cv::Mat image;
  renderer.render(toolAt({0.0, 0.05, 0.5}), image);
  vision::coverImage(image, 1.0, 0);
  vision::MarkerDetector detector({}, 640, 480);
  EXPECT_FALSE(detector.detect(image).found());
}

}  // namespace
}  // namespace capstan::simulation
