#include "widgets/panels/calibration/coverage_picture.h"

#include <QPainter>
#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace capstan::widgets {

namespace {

constexpr int kBars = 4;
constexpr double kLine = 20.0, kTitle = 20.0;  // [px]

}  // namespace

CoveragePicture::CoveragePicture(const QString& title, QWidget* parent) : QWidget(parent), title_(title) {
  setAccessibleName(tr("coverage of the %1 camera").arg(title.toLower()));
}

void CoveragePicture::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void CoveragePicture::showImage(const cv::Mat& bgr, const std::optional<vision::BoardCorners>& found) {
  cv::Mat shown;
  if (bgr.channels() == 1)
    cv::cvtColor(bgr, shown, cv::COLOR_GRAY2RGB);
  else
    cv::cvtColor(bgr, shown, cv::COLOR_BGR2RGB);
  image_ =
      QImage(shown.data, shown.cols, shown.rows, static_cast<int>(shown.step), QImage::Format_RGB888).copy();
  size_ = shown.size();
  found_ = found ? found->pixels : std::vector<cv::Point2f>{};
  update();
}

void CoveragePicture::clearImage() {
  image_ = {};
  found_.clear();
  update();
}

void CoveragePicture::showCoverage(const std::vector<std::vector<cv::Point2f>>& corners, const cv::Size& size,
                                   const vision::BoardCoverage& coverage) {
  corners_ = corners;
  if (!size.empty()) size_ = size;
  coverage_ = coverage;
  update();
}

void CoveragePicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(9.5));
  painter.setPen(theme_.muted);
  painter.drawText(QRectF(0, 0, width(), kTitle), Qt::AlignLeft | Qt::AlignVCenter, title_);
  const double bars = kBars * kLine + 4.0;
  drawImage(painter, QRectF(0, kTitle, width(), std::max(40.0, height() - kTitle - bars)));
  drawBars(painter, QRectF(0, height() - bars + 4.0, width(), bars - 4.0));
}

void CoveragePicture::drawImage(QPainter& painter, const QRectF& area) {
  const cv::Size size = size_.empty() ? cv::Size(640, 480) : size_;
  const double scale = std::min(area.width() / size.width, area.height() / size.height);
  const QRectF frame(area.left() + 0.5 * (area.width() - scale * size.width), area.top(), scale * size.width,
                     scale * size.height);
  painter.fillRect(frame, theme_.window);
  if (image_.isNull()) {
    painter.setPen(theme_.muted);
    painter.drawText(frame, Qt::AlignCenter, tr("no image"));
  } else {
    painter.drawImage(frame, image_);
  }
  const auto dots = [&](const std::vector<cv::Point2f>& points, const QColor& colour, double radius) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(colour);
    for (const cv::Point2f& point : points)
      painter.drawEllipse(frame.topLeft() + scale * QPointF(point.x + 0.5, point.y + 0.5), radius, radius);
  };
  QColor taken = theme_.accent;
  taken.setAlpha(150);
  for (const auto& view : corners_) dots(view, taken, 1.6);
  dots(found_, theme_.colour(Quantity::kCamera), 2.6);
  painter.setPen(theme_.border);
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(frame);
}

void CoveragePicture::drawBars(QPainter& painter, const QRectF& area) {
  const std::pair<QString, double> bars[] = {{tr("across"), coverage_.x},
                                             {tr("down"), coverage_.y},
                                             {tr("size"), coverage_.size},
                                             {tr("tilt"), coverage_.skew}};
  const double name = painter.fontMetrics().horizontalAdvance(tr("across")) + 8.0;
  const double number = painter.fontMetrics().horizontalAdvance("100 %") + 8.0;
  double y = area.top();
  for (const auto& [label, share] : bars) {
    const QRectF bar(area.left() + name, y + 6.0, area.width() - name - number, kLine - 12.0);
    painter.setPen(theme_.muted);
    painter.drawText(QRectF(area.left(), y, name, kLine), Qt::AlignLeft | Qt::AlignVCenter, label);
    painter.fillRect(bar, theme_.raised);
    painter.fillRect(QRectF(bar.left(), bar.top(), share * bar.width(), bar.height()), theme_.accent);
    painter.setPen(theme_.text);
    painter.drawText(QRectF(bar.right(), y, number, kLine), Qt::AlignRight | Qt::AlignVCenter,
                     tr("%1 %").arg(qRound(100.0 * share)));
    y += kLine;
  }
}

}  // namespace capstan::widgets
