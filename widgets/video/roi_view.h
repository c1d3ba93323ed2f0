#pragma once

#include <QFontMetrics>
#include <QImage>
#include <QString>
#include <QWidget>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/vision/marker.h"
#include "widgets/figures/theme.h"
#include "widgets/video/roi_layout.h"

namespace capstan::widgets {

/// A line over the image in pixels of the whole frame, for example the projected arm.
struct ImageLine {
  std::vector<Eigen::Vector2d> points;
  QColor colour;
  bool dashed = false;
  double circle = 0.0;  ///< radius of a circle about the last point [px]; 0: none
  QString label;        ///< label at the last point
};

/// View of one camera: the region of interest magnified with the detected circle and centroid, the whole
/// frame as inset with the region's box, and a line with the detection or the reason why there is none. A
/// double click swaps the two images.
class RoiView : public QWidget {
  Q_OBJECT

 public:
  explicit RoiView(const QString& title, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows a whole frame (8-bit BGR, copied) and the detector's result for it. For an empty frame only the
  /// reason is shown.
  void showFrame(const cv::Mat& bgr, const vision::MarkerDetection& detection);
  /// Removes the image and shows `why` instead.
  void clear(const QString& why);
  void setLines(std::vector<ImageLine> lines);
  /// Shows the whole frame large and the region of interest as inset.
  void setWholeFrameLarge(bool large);
  bool wholeFrameLarge() const { return whole_large_; }

  /// The line below the image: `circle 11.3 px · 0.08 px σ · ok`, or the reason why the marker is lost.
  QString caption() const;
  /// The caption shortened to `width` pixels of `metrics`: whole parts are removed from its end, so that no
  /// number is cut; only a single remaining part is elided.
  QString captionWithin(const QFontMetrics& metrics, int width) const;
  bool lost() const { return !detection_.found(); }
  /// Says beside the image that it is an old one, and why no newer one comes; empty: it is of now.
  void setOutdated(const QString& why);
  /// Present positions of the magnified image and the inset, for tests and overlays.
  ImageMap mainMap() const;
  ImageMap insetMap() const;
  QSize sizeHint() const override { return {420, 250}; }
  QSize minimumSizeHint() const override { return {160, 120}; }

 signals:
  void wholeFrameLargeChanged(bool large);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

 private:
  RoiLayout layOut() const;
  cv::Rect wholeFrame() const { return {0, 0, frame_.cols, frame_.rows}; }
  QRectF labelBox(const ImageLine& line, const ImageMap& map) const;
  QRectF markerBox(const ImageMap& map) const;
  void drawHeader(QPainter& painter, const QRect& area) const;
  void drawImage_(QPainter& painter, const ImageMap& map, bool main) const;
  void drawMarker(QPainter& painter, const ImageMap& map, bool main) const;
  void drawLines(QPainter& painter, const ImageMap& map) const;
  void drawCaption(QPainter& painter, const QRect& area) const;

  QString title_, message_, outdated_;
  Theme theme_ = Theme::dark();
  cv::Mat frame_;
  vision::MarkerDetection detection_;
  cv::Rect region_;
  bool whole_large_ = false;
  std::vector<ImageLine> lines_;
};

}  // namespace capstan::widgets
