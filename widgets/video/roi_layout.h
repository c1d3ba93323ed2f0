#pragma once

#include <Eigen/Core>
#include <QPointF>
#include <QRect>
#include <QRectF>
#include <QSize>
#include <opencv2/core/types.hpp>

#include "core/vision/marker.h"

namespace capstan::widgets {

/// Part of an image shown in part of a widget. Image pixel (0, 0) is the centre of the top-left pixel, so
/// that the picture's edge lies at −0.5.
struct ImageMap {
  QRectF target;    ///< in the widget
  cv::Rect source;  ///< whole pixels of the image

  double scale() const { return source.width > 0 ? target.width() / source.width : 0.0; }
  QPointF toWidget(const Eigen::Vector2d& pixel) const {
    return {target.x() + (pixel.x() + 0.5 - source.x) * scale(),
            target.y() + (pixel.y() + 0.5 - source.y) * scale()};
  }
};

/// Where the parts of a region-of-interest view lie: header, magnified picture, whole frame as inset,
/// caption.
struct RoiLayout {
  QRect header, caption;
  QRectF main, inset;         ///< aspect ratios of what they show are kept
  bool inset_inside = false;  ///< no room beside the picture: the inset covers a corner of it
};

/// Lays out a widget of `size`. The picture gets all the height there is; the inset gets the width left
/// beside it, or a corner when less than `least_inset` [px] is left.
RoiLayout layOutRoi(const QSize& size, int text_height, const cv::Size& main_shape,
                    const cv::Size& inset_shape, int least_inset = 88);

/// The part of a frame of `frame` size to magnify: the region that was searched, or as large a square about
/// the marker when it was found (or sought) outside, inside the frame in any case.
cv::Rect regionToShow(const vision::MarkerDetection& detection, const cv::Size& frame, int side,
                      const cv::Rect& last);

}  // namespace capstan::widgets
