#include "widgets/panels/marker/marker_picture.h"

#include <QMouseEvent>
#include <QPainter>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/names.h"

namespace capstan::widgets {
namespace {

const cv::Scalar kTint(255, 0, 255);  // B, G, R; magenta is no marker's colour in a laboratory
constexpr double kTintShare = 0.55;

}  // namespace

MarkerPicture::MarkerPicture(const QString& title, QWidget* parent) : QWidget(parent), title_(title) {
  setCursor(Qt::CrossCursor);
  setAccessibleName(tr("%1 picture: click the marker").arg(title));
}

void MarkerPicture::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void MarkerPicture::showPicture(const cv::Mat& bgr, const cv::Mat& mask,
                                const vision::MarkerDetection& marker) {
  marker_ = marker;
  if (bgr.empty()) return clear();
  cv::Mat tinted = bgr.clone(), tint(bgr.size(), bgr.type(), kTint), mixed;
  cv::addWeighted(bgr, 1.0 - kTintShare, tint, kTintShare, 0.0, mixed);
  if (mask.size() == bgr.size()) mixed.copyTo(tinted, mask);
  picture_ =
      QImage(tinted.data, tinted.cols, tinted.rows, static_cast<int>(tinted.step), QImage::Format_BGR888)
          .convertToFormat(QImage::Format_RGB32);
  update();
}

void MarkerPicture::clear() {
  picture_ = {};
  update();
}

QRectF MarkerPicture::area() const {
  const int line = QFontMetrics(textFont(10.0)).height() + 4;
  const QRectF room(0, line, width(), std::max(1, height() - 2 * line));
  if (picture_.isNull()) return room;
  const QSizeF size = QSizeF(picture_.size()).scaled(room.size(), Qt::KeepAspectRatio);
  return {QPointF(0.5 * (width() - size.width()), room.top()), size};
}

QPoint MarkerPicture::place(const QPoint& pixel) const {
  const QRectF where = area();
  const double scale = where.width() / std::max(1, picture_.width());
  return (where.topLeft() + (QPointF(pixel) + QPointF(0.5, 0.5)) * scale).toPoint();
}

void MarkerPicture::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.setFont(textFont(10.0));
  const int line = painter.fontMetrics().height() + 4;
  painter.setPen(theme_.text);
  painter.drawText(QRect(0, 0, width(), line), Qt::AlignLeft | Qt::AlignVCenter, title_);
  const QRectF where = area();
  painter.setPen(theme_.muted);
  if (picture_.isNull()) {
    painter.drawText(where, Qt::AlignCenter, tr("no picture"));
    return;
  }
  painter.drawImage(where, picture_);
  QString words = QString::fromStdString(std::string(base::nameOf(marker_.fault)));
  if (marker_.found()) {
    const double scale = where.width() / picture_.width();
    const QPointF centre =
        where.topLeft() + QPointF(marker_.centroid.x() + 0.5, marker_.centroid.y() + 0.5) * scale;
    painter.setPen(QPen(theme_.accent, 2.0));
    painter.drawEllipse(centre, marker_.radius * scale + 2.0, marker_.radius * scale + 2.0);
    words = tr("%1, %2 px, radius %3 px, σ %4 px")
                .arg(marker_.centroid.x(), 0, 'f', 1)
                .arg(marker_.centroid.y(), 0, 'f', 1)
                .arg(marker_.radius, 0, 'f', 1)
                .arg(marker_.sigma, 0, 'f', 2);
  }
  painter.setPen(marker_.found() ? theme_.muted : theme_.inkOf(theme_.warning));
  painter.drawText(
      QRectF(where.left(), where.bottom() + 2, std::max<double>(where.width(), width() - where.left()), line),
      Qt::AlignLeft | Qt::AlignVCenter, words);
}

void MarkerPicture::mousePressEvent(QMouseEvent* event) {
  const QRectF where = area();
  if (picture_.isNull() || event->button() != Qt::LeftButton || !where.contains(event->localPos())) return;
  const QPointF at = (event->localPos() - where.topLeft()) * (picture_.width() / where.width());
  Q_EMIT picked({static_cast<int>(at.x()), static_cast<int>(at.y())});
}

}  // namespace capstan::widgets
