#pragma once

#include <QImage>
#include <QWidget>
#include <opencv2/core.hpp>
#include <vector>

#include "core/vision/board_finder.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// One camera's coverage: its image with the corners found in it, the corners of all views, and below a bar
/// for each quantity that a good calibration needs.
class CoveragePicture : public QWidget {
  Q_OBJECT

 public:
  explicit CoveragePicture(const QString& title, QWidget* parent = nullptr);
  void setTheme(const Theme& theme);
  void showImage(const cv::Mat& bgr, const std::optional<vision::BoardCorners>& found);
  void showCoverage(const std::vector<std::vector<cv::Point2f>>& corners, const cv::Size& size,
                    const vision::BoardCoverage& coverage);
  void clearImage();
  QSize sizeHint() const override { return {320, 320}; }
  QSize minimumSizeHint() const override { return {200, 170}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void drawImage(QPainter& painter, const QRectF& area);
  void drawBars(QPainter& painter, const QRectF& area);

  QString title_;
  Theme theme_ = Theme::dark();
  QImage image_;
  std::vector<cv::Point2f> found_;
  std::vector<std::vector<cv::Point2f>> corners_;
  cv::Size size_;
  vision::BoardCoverage coverage_;
};

}  // namespace capstan::widgets
