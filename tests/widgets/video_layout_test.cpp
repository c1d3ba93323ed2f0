#include <gtest/gtest.h>

#include "widgets/video/roi_layout.h"

namespace capstan::widgets {
namespace {

const cv::Size kFrame(640, 480), kRoi(100, 100);

TEST(RoiLayout, KeepsAspectRatiosAndStaysInside) {
  for (const QSize size :
       {QSize(160, 120), QSize(300, 500), QSize(420, 250), QSize(640, 300), QSize(1200, 400)}) {
    const RoiLayout layout = layOutRoi(size, 20, kRoi, kFrame);
    const QRectF all(QPointF(0, 0), size);
    EXPECT_TRUE(all.contains(layout.main)) << size.width();
    EXPECT_TRUE(all.contains(layout.inset)) << size.width();
    EXPECT_NEAR(layout.main.width(), layout.main.height(), 1.0);
    EXPECT_NEAR(layout.inset.width() / layout.inset.height(), 4.0 / 3.0, 0.06);
    EXPECT_FALSE(layout.main.intersects(layout.header));
    EXPECT_FALSE(layout.main.intersects(layout.caption));
  }
}

TEST(RoiLayout, InsetMovesIntoACornerWhenThereIsNoRoomBeside) {
  EXPECT_FALSE(layOutRoi({500, 250}, 20, kRoi, kFrame).inset_inside);
  const RoiLayout narrow = layOutRoi({260, 400}, 20, kRoi, kFrame);
  EXPECT_TRUE(narrow.inset_inside);
  EXPECT_TRUE(narrow.main.contains(narrow.inset));
}

TEST(RoiLayout, InsetTakesAFreeCorner) {
  const QRectF main(10, 20, 200, 150);
  const QSizeF size(70, 50);
  const QRectF top_right(140, 20, 70, 50), bottom_right(140, 120, 70, 50), bottom_left(10, 120, 70, 50);
  EXPECT_EQ(freeCorner(main, size, {}), top_right);
  EXPECT_EQ(freeCorner(main, size, {QRectF(100, 80, 30, 20)}), top_right);
  EXPECT_EQ(freeCorner(main, size, {QRectF(180, 30, 30, 12)}), bottom_right);
  EXPECT_EQ(freeCorner(main, size, {QRectF(180, 30, 30, 12), QRectF(150, 150, 10, 5)}), bottom_left);
  EXPECT_EQ(freeCorner(main, size, {main}), top_right) << "no corner is free";
}

TEST(ImageMap, PixelCentresLieHalfAPixelInside) {
  const ImageMap map{QRectF(10, 20, 300, 300), {200, 100, 100, 100}};
  EXPECT_DOUBLE_EQ(map.scale(), 3.0);
  EXPECT_EQ(map.toWidget({200.0, 100.0}), QPointF(11.5, 21.5));
  EXPECT_EQ(map.toWidget({199.5, 99.5}), QPointF(10.0, 20.0));
  EXPECT_EQ(map.toWidget({299.5, 199.5}), QPointF(310.0, 320.0));
}

TEST(RegionToShow, IsTheSearchedRegionOrFollowsTheMarkerInsideTheFrame) {
  vision::MarkerDetection detection;
  detection.fault = vision::MarkerFault::kNone;
  detection.roi = {120, 80, 100, 100};
  EXPECT_EQ(regionToShow(detection, kFrame, 100, {}), cv::Rect(120, 80, 100, 100));
  detection.full_frame = true;
  detection.roi = {0, 0, 640, 480};
  detection.centroid = {300.2, 200.7};
  EXPECT_EQ(regionToShow(detection, kFrame, 100, {}), cv::Rect(250, 151, 100, 100));
  detection.centroid = {635, 3};
  EXPECT_EQ(regionToShow(detection, kFrame, 100, {}), cv::Rect(540, 0, 100, 100));
  detection.fault = vision::MarkerFault::kNoPixels;
  EXPECT_EQ(regionToShow(detection, kFrame, 100, {50, 60, 100, 100}), cv::Rect(50, 60, 100, 100))
      << "the last one";
  EXPECT_EQ(regionToShow(detection, kFrame, 100, {}), cv::Rect(270, 190, 100, 100))
      << "the middle without a last one";
  EXPECT_EQ(regionToShow(detection, {64, 48}, 100, {}).size(), cv::Size(48, 48))
      << "a frame smaller than the region";
}

}  // namespace
}  // namespace capstan::widgets
