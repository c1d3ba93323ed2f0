#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/base/random.h"
#include "tests/widgets/picture.h"
#include "widgets/video/roi_view.h"
#include "widgets/video/stereo_view.h"

namespace capstan::widgets {
namespace {

/// A grey, noisy 640×480 frame with a green ball; the detection is of the ball, as a perfect detector gives
/// it.
struct Observation {
  cv::Mat frame;
  vision::MarkerDetection detection;
};

Observation observationOf(const Eigen::Vector2d& centre, double radius, std::array<int, 4> roi) {
  Observation observation;
  observation.frame.create(480, 640, CV_8UC3);
  base::Random random(3);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const double from = (Eigen::Vector2d(x, y) - centre).norm();
      const double light = 70 + 40.0 * x / 640 + 6.0 * random.normal();
      const double ball = std::clamp(radius + 0.5 - from, 0.0, 1.0), shade = 1.0 - 0.5 * from / radius;
      const cv::Vec3d green(60 * shade, 190 * shade, 50 * shade);
      for (int c = 0; c < 3; ++c)
        observation.frame.at<cv::Vec3b>(y, x)[c] =
            cv::saturate_cast<uchar>((1.0 - ball) * light + ball * green[c]);
    }
  observation.detection.fault = vision::MarkerFault::kNone;
  observation.detection.centroid = centre;
  observation.detection.radius = radius;
  observation.detection.sigma = 0.083;
  observation.detection.roi = roi;
  return observation;
}

vision::MarkerDetection lostBecause(vision::MarkerFault fault, std::array<int, 4> roi) {
  vision::MarkerDetection detection;
  detection.fault = fault;
  detection.roi = roi;
  return detection;
}

TEST(RoiView, DrawsTheCircleAroundTheMagnifiedMarker) {
  RoiView view("LEFT");
  view.resize(620, 360);
  const Observation observation = observationOf({311.35, 207.8}, 11.3, {270, 160, 100, 100});
  view.showFrame(observation.frame, observation.detection);
  const QImage image = test::grab(view, "video_roi");
  const ImageMap map = view.mainMap();
  const test::Count ring =
      test::count(image, map.target.toAlignedRect(), Theme::dark().colour(Quantity::kCamera), 24);
  ASSERT_GT(ring.pixels, 200);
  const QPointF wanted = map.toWidget(observation.detection.centroid);
  EXPECT_NEAR(ring.centre.x(), wanted.x(), 1.0);
  EXPECT_NEAR(ring.centre.y(), wanted.y(), 1.0);
  EXPECT_NEAR(ring.box.width(), 2.0 * 11.3 * map.scale(), 3.0);
  EXPECT_NEAR(ring.box.height(), 2.0 * 11.3 * map.scale(), 3.0);
  EXPECT_EQ(view.caption(), QString::fromUtf8("circle 11.3 px · 0.08 px σ · ok"));
}

TEST(RoiView, NarrowCaptionLeavesOutWholePartsAndCutsNoNumber) {
  RoiView view("LEFT");
  Observation observation = observationOf({311.35, 207.8}, 11.3, {270, 160, 100, 100});
  observation.detection.full_frame = true;
  view.showFrame(observation.frame, observation.detection);
  const QFontMetrics metrics(numberFont(10.0));
  for (const char* text :
       {"circle 11.3 px · 0.08 px σ · ok · found by full search", "circle 11.3 px · 0.08 px σ · ok",
        "circle 11.3 px · 0.08 px σ", "circle 11.3 px"}) {
    const QString wanted = QString::fromUtf8(text);
    EXPECT_EQ(view.captionWithin(metrics, metrics.horizontalAdvance(wanted) + 1), wanted);
  }
  EXPECT_EQ(view.captionWithin(metrics, metrics.horizontalAdvance("circle 11.3 px - 0.08")),
            "circle 11.3 px");
}

TEST(RoiView, KeepsItsPicturesLargeAtTheWindowsSizes) {
  StereoView stereo;
  tracking::Snapshot snapshot{};
  const Observation left = observationOf({311, 207}, 11.0, {270, 160, 100, 100});
  snapshot.marker = {left.detection, lostBecause(vision::MarkerFault::kNoPixels, {220, 160, 100, 100})};
  stereo.showFrames(left.frame, left.frame, snapshot);
  for (const QSize size : {QSize(430, 460), QSize(430, 640)}) {
    stereo.resize(size);
    test::grab(stereo, QString("video_window_%1").arg(size.height()));
    const ImageMap map = stereo.left().mainMap();
    EXPECT_GE(map.scale(), 1.5) << size.height();
    EXPECT_FALSE(map.target.intersects(stereo.left().insetMap().target)) << size.height();
    EXPECT_EQ(map.source, cv::Rect(270, 160, 100, 100));
  }
}

TEST(RoiView, ShowsImagePixelsAsCrispSquares) {
  RoiView view("LEFT");
  view.resize(460, 360);
  cv::Mat frame(480, 640, CV_8UC3, cv::Scalar::all(0));
  frame.at<cv::Vec3b>(210, 315) = {255, 255, 255};
  view.showFrame(frame, lostBecause(vision::MarkerFault::kNoPixels, {270, 160, 100, 100}));
  const QImage image = test::grab(view, "video_crisp");
  const ImageMap map = view.mainMap();
  const test::Count white =
      test::count(image, map.target.toAlignedRect().adjusted(4, 4, -4, -4), Qt::white, 4);
  EXPECT_NEAR(white.pixels, map.scale() * map.scale(), 2.0 * map.scale());
  EXPECT_NEAR(white.centre.x(), map.toWidget({315, 210}).x(), 0.8);
  EXPECT_NEAR(white.centre.y(), map.toWidget({315, 210}).y(), 0.8);
}

TEST(RoiView, MarksTheRegionInTheWholeFrame) {
  RoiView view("RIGHT");
  view.resize(620, 300);
  const Observation observation = observationOf({480, 330}, 9.0, {430, 280, 100, 100});
  view.showFrame(observation.frame, observation.detection);
  const QImage image = test::grab(view, "video_inset");
  const ImageMap inset = view.insetMap();
  const test::Count box =
      test::count(image, inset.target.toAlignedRect(), Theme::dark().colour(Quantity::kCamera), 24);
  EXPECT_NEAR(box.box.left(), inset.toWidget({429.5, 0}).x(), 2.0);
  EXPECT_NEAR(box.box.right(), inset.toWidget({529.5, 0}).x(), 2.0);
  EXPECT_NEAR(box.box.top(), inset.toWidget({0, 279.5}).y(), 2.0);
  EXPECT_NEAR(box.box.bottom(), inset.toWidget({0, 379.5}).y(), 2.0);
}

TEST(RoiView, SaysWhyTheMarkerIsLostInWordsAndColour) {
  RoiView view("LEFT");
  view.resize(620, 300);
  Observation observation = observationOf({311, 207}, 11.0, {270, 160, 100, 100});
  view.showFrame(observation.frame, observation.detection);
  const QImage found = test::grab(view, "video_found");
  EXPECT_EQ(test::count(found, found.rect(), Theme::dark().warning, 4).pixels, 0);
  observation.frame.setTo(cv::Scalar(28, 30, 34));
  view.showFrame(observation.frame, lostBecause(vision::MarkerFault::kNoPixels, {270, 160, 100, 100}));
  EXPECT_TRUE(view.lost());
  EXPECT_EQ(view.caption(), "no pixels of the marker's colour");
  const QImage lost = test::grab(view, "video_lost");
  const auto caption = QRect(0, lost.height() - 30, lost.width(), 30);
  EXPECT_GT(test::count(lost, caption, Theme::dark().warning, 4).pixels, 200) << "the word LOST on amber";
  EXPECT_EQ(
      test::count(lost, view.mainMap().target.toAlignedRect(), Theme::dark().colour(Quantity::kCamera), 24)
          .pixels,
      0)
      << "no circle of a marker that is not there";
}

TEST(RoiView, SaysThatItsImageIsAnOldOne) {
  const Observation observation = observationOf({320, 240}, 9.0, {270, 190, 100, 100});
  StereoView view;
  view.resize(400, 500);
  view.left().showFrame(observation.frame, observation.detection);
  view.right().showFrame(observation.frame, observation.detection);
  tracking::SideStatus cameras;
  cameras.name = "cameras", cameras.received = 20, cameras.part = "right", cameras.silent_for = 3.1;
  cameras.state = tracking::SideStatus::State::kSilent;
  view.setOutdated({cameras});
  EXPECT_TRUE(view.left().caption().startsWith("circle"));
  EXPECT_EQ(view.right().caption(), "silent for 3 s");
  test::grab(view, "roi_old_image");
  cameras.state = tracking::SideStatus::State::kReceiving;
  view.setOutdated({cameras});
  EXPECT_TRUE(view.right().caption().startsWith("circle"));
}

TEST(RoiView, SwapsThePicturesOnDoubleClick) {
  StereoView stereo;
  stereo.resize(700, 640);
  tracking::Snapshot snapshot{};
  const Observation left = observationOf({311, 207}, 11.0, {270, 160, 100, 100}),
                    right = observationOf({260, 207}, 11.0, {220, 160, 100, 100});
  snapshot.marker = {left.detection, right.detection};
  stereo.showFrames(left.frame, right.frame, snapshot);
  EXPECT_EQ(stereo.left().mainMap().source, cv::Rect(270, 160, 100, 100));
  stereo.left().setWholeFrameLarge(true);
  EXPECT_TRUE(stereo.right().wholeFrameLarge());
  EXPECT_EQ(stereo.right().mainMap().source, cv::Rect(0, 0, 640, 480));
  stereo.setLines({{{{{{200, 20}, {311, 207}}, QColor("#009E73"), false, 11.0, "new"},
                     {{{190, 20}, {296, 207}}, QColor("#D55E00"), true, 11.0, "old"}},
                    {}}});
  const QImage image = test::grab(stereo, "video_whole_with_arm");
  const QPoint middle = stereo.left().mainMap().toWidget({255.5, 113.5}).toPoint();
  EXPECT_GT(test::count(image, QRect(middle - QPoint(4, 4), QSize(9, 9)), QColor("#009E73"), 24).pixels, 4);
}

TEST(RoiView, InsetCoversNeitherTheMarkerNorALabel) {
  RoiView view("LEFT");
  view.resize(300, 260);
  view.setWholeFrameLarge(true);
  view.show();
  const Observation seen = observationOf({560, 60}, 11.0, {500, 10, 100, 100});
  view.showFrame(seen.frame, seen.detection);
  view.setLines({{{{500, 20}, {560, 60}}, QColor("#009E73"), false, 11.0, "new"}});
  test::grab(view, "video_inset_elsewhere");
  EXPECT_FALSE(view.insetMap().target.contains(view.mainMap().toWidget({560.0, 60.0})));
  EXPECT_TRUE(view.mainMap().target.contains(view.insetMap().target));
}

TEST(RoiView, LightThemeAndSmallSizes) {
  StereoView stereo;
  stereo.setTheme(Theme::light());
  tracking::Snapshot snapshot{};
  const Observation left = observationOf({311, 207}, 11.0, {270, 160, 100, 100});
  snapshot.marker = {left.detection, lostBecause(vision::MarkerFault::kTwoCandidates, {220, 160, 100, 100})};
  stereo.showFrames(left.frame, left.frame, snapshot);
  for (const QSize size : {QSize(420, 420), QSize(230, 460), QSize(900, 260)}) {
    stereo.resize(size);
    const QImage image = test::grab(stereo, QString("video_light_%1").arg(size.width()));
    const ImageMap map = stereo.left().mainMap();
    EXPECT_GT(map.target.width(), 80) << size.width();
    EXPECT_GT(
        test::count(image, map.target.toAlignedRect(), Theme::light().colour(Quantity::kCamera), 24).pixels,
        30);
  }
  stereo.clear("This source has no images");
  test::grab(stereo, "video_none");
  EXPECT_EQ(stereo.left().caption(), "This source has no images");
}

}  // namespace
}  // namespace capstan::widgets
