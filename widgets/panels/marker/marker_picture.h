#pragma once

#include <QImage>
#include <QPoint>
#include <QString>
#include <QWidget>
#include <opencv2/core/mat.hpp>

#include "core/vision/marker.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Whole picture of one camera with the pixels inside the marker's limits tinted and the detected circle. A
/// click emits the picture's pixel.
class MarkerPicture : public QWidget {
  Q_OBJECT

 public:
  explicit MarkerPicture(const QString& title, QWidget* parent = nullptr);

  void setTheme(const Theme& theme);
  /// Shows an 8-bit BGR picture (copied), the mask of the limits (0 or 255, same size) and the detection.
  void showPicture(const cv::Mat& bgr, const cv::Mat& mask, const vision::MarkerDetection& marker);
  void clear();
  /// Position of the picture's pixel in the widget, for tests.
  QPoint place(const QPoint& pixel) const;

  QSize sizeHint() const override { return {400, 320}; }
  QSize minimumSizeHint() const override { return {220, 180}; }

 signals:
  void picked(const QPoint& pixel);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  QRectF area() const;  ///< of the picture in the widget

  QString title_;
  Theme theme_ = Theme::dark();
  QImage picture_;
  vision::MarkerDetection marker_;
};

}  // namespace capstan::widgets
