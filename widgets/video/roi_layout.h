#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QRect>
#include <QRectF>
#include <QSize>
#include <opencv2/core/types.hpp>
#include <vector>

#include "core/vision/marker.h"

namespace capstan::widgets {

/// Part of an image that is shown in part of a widget. Image pixel (0, 0) is the centre of the top-left
/// pixel, so the image's edge is at −0.5.
struct ImageMap {
  QRectF target;    ///< area in the widget
  cv::Rect source;  ///< area in the image, whole pixels

  double scale() const { return source.width > 0 ? target.width() / source.width : 0.0; }
  QPointF toWidget(const Eigen::Vector2d& pixel) const {
    return {target.x() + (pixel.x() + 0.5 - source.x) * scale(),
            target.y() + (pixel.y() + 0.5 - source.y) * scale()};
  }
};

/// Positions of the parts of a region-of-interest view: header, magnified image, whole frame as inset,
/// caption.
struct RoiLayout {
  QRect header, caption;
  QRectF main, inset;         ///< with the aspect ratios of their images
  bool inset_inside = false;  ///< no room beside the image: the inset covers a corner of it
};

/// Lays out a widget of `size`. The image gets the whole height. The inset gets the width beside it, or a
/// corner of the image if that width is less than 88 px.
RoiLayout layOutRoi(const QSize& size, int text_height, const cv::Size& main_shape,
                    const cv::Size& inset_shape);

/// The corner of `main` for an inset of `size` that covers none of `kept`: top right, else the next one
/// clockwise that is free; top right if none is.
QRectF freeCorner(const QRectF& main, const QSizeF& size, const std::vector<QRectF>& kept);

/// The part of a frame of size `frame` to magnify, always inside the frame: the region that was searched, of
/// `side` pixels. After a search of the whole frame: a region of that size about the marker, or `last` if
/// none was found.
cv::Rect regionToShow(const vision::MarkerDetection& detection, const cv::Size& frame, int side,
                      const cv::Rect& last);

}  // namespace capstan::widgets
