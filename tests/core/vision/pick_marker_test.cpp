#include "core/vision/pick_marker.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/vision/marker_detector.h"
#include "core/vision/picture.h"
#include "core/vision/picture_markers.h"
#include "tests/support/disc_image.h"
#include "tests/support/folders.h"

namespace capstan::vision {
namespace {

using testing::DiscScene;
using testing::renderDisc;

const std::vector<Eigen::Vector3d> kColours = {{50, 190, 60}, {40, 40, 180}, {190, 70, 40}, {30, 170, 190}};

TEST(PickMarker, LimitsFindTheMarkerInOtherPictures) {
  for (std::size_t i = 0; i < kColours.size(); ++i) {
    DiscScene scene;
    scene.colour = kColours[i];
    base::Random random(i);
    const auto picked = pickMarker(renderDisc(scene, random), {83, 56});
    ASSERT_TRUE(picked.has_value()) << base::nameOf(picked.error());
    EXPECT_LT((picked->mark.centroid - scene.centre).norm(), 0.2);
    MarkerDetector detector(picked->options, scene.width, scene.height);
    scene.centre = {40.3, 80.9};
    scene.radius = 9.0;
    scene.colour *= 0.75;  // less light
    const MarkerDetection other = detector.detect(renderDisc(scene, random));
    ASSERT_TRUE(other.found()) << i << ": " << base::nameOf(other.fault);
    EXPECT_LT((other.centroid - scene.centre).norm(), 0.3);
    scene.radius = 0.0;
    EXPECT_FALSE(detector.detect(renderDisc(scene, random)).found()) << "the background is no marker";
  }
}

TEST(PickMarker, RefusesAndSaysWhy) {
  base::Random random(1);
  const cv::Mat picture = renderDisc({}, random);
  const auto faultAt = [&](int u, int v) {
    const auto picked = pickMarker(picture, {u, v});
    return picked ? "none" : base::nameOf(picked.error());
  };
  EXPECT_EQ(faultAt(-1, 5), base::nameOf(PickFault::kOutside));
  EXPECT_EQ(faultAt(160, 5), base::nameOf(PickFault::kOutside));
  EXPECT_EQ(faultAt(10, 10), base::nameOf(PickFault::kNoColour));
  cv::Mat green(120, 160, CV_8UC3, cv::Scalar(50, 190, 60));
  EXPECT_EQ(base::nameOf(pickMarker(green, {80, 60}).error()), base::nameOf(PickFault::kBackground));
  cv::Mat speck(120, 160, CV_8UC3, cv::Scalar(100, 100, 100));
  speck(cv::Rect(79, 59, 3, 3)).setTo(cv::Scalar(50, 190, 60));
  EXPECT_EQ(base::nameOf(pickMarker(speck, {80, 60}).error()), base::nameOf(PickFault::kTooSmall));
}

TEST(PickMarker, TightensTheLimitsUntilTheBackgroundIsQuiet) {
  base::Random random(2);
  cv::Mat picture = renderDisc({}, random);
  cv::circle(picture, {30, 30}, 12, cv::Scalar(70, 130, 90), cv::FILLED);  // dull, nearly the marker's hue
  const auto picked = pickMarker(picture, {80, 60});
  ASSERT_TRUE(picked.has_value());
  EXPECT_FALSE(picked->ambiguous());
  cv::circle(picture, {30, 30}, 12, cv::Scalar(50, 190, 60), cv::FILLED);  // a second marker
  const auto twice = pickMarker(picture, {80, 60});
  ASSERT_TRUE(twice.has_value());
  EXPECT_TRUE(twice->ambiguous());
}

// A red mark on the jaw of a da Vinci tool, ten pairs; a click in each of the twenty pictures.
TEST(PickMarker, OneClickFindsTheRealMarkInAllPairs) {
  const auto folder = test::dataFolder() / "davinci-red-marker";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  std::vector<std::array<cv::Mat, 2>> pairs;
  for (int i = 1; i <= 10; ++i)
    pairs.push_back({readPicture(folder / fmt::format("left{:02}.jpg", i)),
                     readPicture(folder / fmt::format("right{:02}.jpg", i))});
  // The mark as a person sees it: column and row in the left and the right picture [px].
  const std::array<std::array<cv::Point, 2>, 10> mark = {{{{{347, 331}, {154, 330}}},
                                                          {{{547, 318}, {349, 316}}},
                                                          {{{247, 254}, {69, 253}}},
                                                          {{{569, 174}, {390, 173}}},
                                                          {{{497, 267}, {320, 266}}},
                                                          {{{450, 391}, {261, 389}}},
                                                          {{{230, 368}, {43, 367}}},
                                                          {{{511, 213}, {339, 212}}},
                                                          {{{468, 283}, {286, 283}}},
                                                          {{{467, 409}, {268, 407}}}}};
  for (std::size_t click = 0; click < 20; ++click) {
    const auto picked = pickMarker(pairs[click / 2][click % 2], mark[click / 2][click % 2]);
    ASSERT_TRUE(picked.has_value()) << click << ": " << base::nameOf(picked.error());
    EXPECT_FALSE(picked->ambiguous()) << click;
    PictureMarkers finder(picked->options);
    int found = 0;
    for (std::size_t pair = 0; pair < pairs.size(); ++pair) {
      const auto markers = finder.inFrames(pairs[pair]);
      found += markers[0].found() && markers[1].found();
      for (std::size_t side = 0; side < 2; ++side) {
        const Eigen::Vector2d seen(mark[pair][side].x, mark[pair][side].y);
        if (!markers[side].found()) continue;
        EXPECT_LT((markers[side].centroid - seen).norm(), 4.0) << "click " << click << ", pair " << pair + 1;
      }
    }
    EXPECT_GE(found, 9) << click;
  }
}

}  // namespace
}  // namespace capstan::vision
