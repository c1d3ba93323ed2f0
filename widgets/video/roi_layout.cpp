#include "widgets/video/roi_layout.h"

#include <algorithm>
#include <cmath>

namespace capstan::widgets {

namespace {

constexpr int kMargin = 8;
constexpr int kGap = 8;
constexpr int kLeastInset = 88;  ///< least width of the inset beside the image [px]

QSizeF fit(const cv::Size& shape, double width, double height) {
  if (shape.width <= 0 || shape.height <= 0 || width <= 0 || height <= 0) return {0.0, 0.0};
  const double scale = std::min(width / shape.width, height / shape.height);
  return {std::floor(shape.width * scale), std::floor(shape.height * scale)};
}

}  // namespace

RoiLayout layOutRoi(const QSize& size, int text_height, const cv::Size& main_shape,
                    const cv::Size& inset_shape) {
  RoiLayout layout;
  const int width = size.width() - 2 * kMargin;
  layout.header = QRect(kMargin, kMargin / 2, width, text_height);
  layout.caption = QRect(kMargin, size.height() - kMargin / 2 - text_height, width, text_height);
  const int top = layout.header.bottom() + 1 + kMargin / 2;
  const int height = layout.caption.top() - kMargin / 2 - top;
  const QSizeF main = fit(main_shape, width, height);
  layout.main = QRectF(QPointF(kMargin, top), main);
  const double left = width - main.width() - kGap;
  QSizeF inset = fit(inset_shape, left, height);
  layout.inset_inside = inset.width() < kLeastInset;
  if (layout.inset_inside) {
    layout.main.moveLeft(kMargin + std::floor((width - main.width()) / 2.0));
    inset = fit(inset_shape, main.width() * 0.36, main.height() * 0.36);
    layout.inset = QRectF(QPointF(layout.main.right() - inset.width(), layout.main.top()), inset);
  } else {
    layout.inset = QRectF(QPointF(layout.main.right() + kGap, top), inset);
  }
  return layout;
}

QRectF freeCorner(const QRectF& main, const QSizeF& size, const std::vector<QRectF>& kept) {
  const double right = main.right() - size.width(), bottom = main.bottom() - size.height();
  const QPointF corners[] = {{right, main.top()}, {right, bottom}, {main.left(), bottom}, main.topLeft()};
  for (const QPointF& corner : corners) {
    const QRectF inset(corner, size);
    const auto covers = [&](const QRectF& box) { return inset.intersects(box); };
    if (std::none_of(kept.begin(), kept.end(), covers)) return inset;
  }
  return {corners[0], size};
}

cv::Rect regionToShow(const vision::MarkerDetection& detection, const cv::Size& frame, int side,
                      const cv::Rect& last) {
  const int size = std::min({side, frame.width, frame.height});
  if (size <= 0) return {};
  cv::Rect region(detection.roi[0], detection.roi[1], size, size);
  if (detection.found() && (detection.full_frame || detection.roi[2] <= 0)) {
    region.x = static_cast<int>(std::lround(detection.centroid.x())) - size / 2;
    region.y = static_cast<int>(std::lround(detection.centroid.y())) - size / 2;
  } else if (detection.full_frame || detection.roi[2] <= 0) {
    region =
        last.width == size ? last : cv::Rect((frame.width - size) / 2, (frame.height - size) / 2, size, size);
  }
  region.x = std::clamp(region.x, 0, frame.width - size);
  region.y = std::clamp(region.y, 0, frame.height - size);
  return region;
}

}  // namespace capstan::widgets
