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

/// A line over the image, in pixels of the whole frame: the projected arm, for one.
struct ImageLine {
  std::vector<Eigen::Vector2d> points;
  QColor colour;
  bool dashed = false;
  double circle = 0.0;  ///< radius of a circle about the last point [px]; 0: none
  QString label;        ///< at the last point
};

/// One camera: the region of interest magnified with the detected circle and centroid, the whole frame as
/// inset with the region's box, and a line that says what was found or why nothing was. A double click swaps
/// the two pictures.
class RoiView : public QWidget {
  Q_OBJECT

 public:
  explicit RoiView(const QString& title, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// A whole frame (8-bit BGR, copied) and what the detector says of it. An empty frame shows the reason
  /// only.
  void showFrame(const cv::Mat& bgr, const vision::MarkerDetection& detection);
  /// Drops the picture; `why` stands in its place.
  void clear(const QString& why);
  void setLines(std::vector<ImageLine> lines);
  /// Whole frame large, region of interest as inset.
  void setWholeFrameLarge(bool large);
  bool wholeFrameLarge() const { return whole_large_; }
  void setRegionSide(int pixels) { side_ = pixels; }

  /// The line under the picture, as `circle 11.3 px · 0.08 px σ · ok` or the reason why the marker is lost.
  QString caption() const;
  /// The caption in `width` pixels of `metrics`: whole parts go from its end, so that no number is cut; only
  /// a single part is elided.
  QString captionWithin(const QFontMetrics& metrics, int width) const;
  bool lost() const { return !detection_.found(); }
  /// The magnified picture and the inset as they lie now, for tests and for overlays of others.
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
  void drawHeader(QPainter& painter, const QRect& area) const;
  void drawImage_(QPainter& painter, const ImageMap& map, bool main) const;
  void drawMarker(QPainter& painter, const ImageMap& map, bool main) const;
  void drawLines(QPainter& painter, const ImageMap& map) const;
  void drawCaption(QPainter& painter, const QRect& area) const;

  QString title_, message_;
  Theme theme_ = Theme::dark();
  cv::Mat frame_;
  vision::MarkerDetection detection_;
  cv::Rect region_;
  int side_ = 100;
  bool whole_large_ = false;
  std::vector<ImageLine> lines_;
};

}  // namespace capstan::widgets
