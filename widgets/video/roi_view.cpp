#include "widgets/video/roi_view.h"

#include <QFontMetrics>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "widgets/video/pills.h"

namespace capstan::widgets {

namespace {

constexpr double kTextPoints = 10.0;
constexpr int kRegionSide = 100;  ///< side of the magnified region [px]
constexpr double kLabelGap = 6.0, kBelow = 14.0,
                 kAbove = -4.0;  ///< of a label's base line from its point [px]

QString text(std::string_view view) { return QString::fromUtf8(view.data(), static_cast<int>(view.size())); }

/// The area `source` of a BGR frame as an image of about `target` size: reduced if larger, never enlarged.
QImage cut(const cv::Mat& frame, const cv::Rect& source, const QSize& target) {
  cv::Mat part = frame(source);
  if (target.width() < part.cols && target.width() > 0 && target.height() > 0)
    cv::resize(part, part, {target.width(), target.height()}, 0, 0, cv::INTER_LINEAR);
  QImage image(part.cols, part.rows, QImage::Format_RGB32);
  cv::Mat view(image.height(), image.width(), CV_8UC4, image.bits(),
               static_cast<std::size_t>(image.bytesPerLine()));
  cv::cvtColor(part, view, cv::COLOR_BGR2BGRA);
  return image;
}

/// Strokes `path` in `colour` over a dark outline, so that it is visible on any image.
void strokeWithHalo(QPainter& painter, const QPainterPath& path, const QColor& colour, double width,
                    Qt::PenStyle style = Qt::SolidLine) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 150), width + 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  painter.setPen(QPen(colour, width, style, Qt::FlatCap, Qt::RoundJoin));
  painter.drawPath(path);
}

}  // namespace

RoiView::RoiView(const QString& title, QWidget* parent)
    : QWidget(parent), title_(title), message_("no pair of images yet") {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setToolTip(
      "Double click: whole frame or region of interest large.\n"
      "Caption: radius of the fitted circle, standard deviation of its centre per axis.");
  setAccessibleName(title + " camera");
}

void RoiView::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void RoiView::showFrame(const cv::Mat& bgr, const vision::MarkerDetection& detection) {
  detection_ = detection;
  if (bgr.empty()) {
    frame_.release();
  } else {
    bgr.copyTo(frame_);
    region_ = regionToShow(detection_, frame_.size(), kRegionSide, region_);
  }
  message_ = "no image";
  update();
}

void RoiView::clear(const QString& why) {
  frame_.release();
  detection_ = {};
  message_ = why;
  update();
}

void RoiView::setOutdated(const QString& why) {
  if (why == outdated_) return;
  outdated_ = why;
  update();
}

void RoiView::setLines(std::vector<ImageLine> lines) {
  lines_ = std::move(lines);
  update();
}

void RoiView::setWholeFrameLarge(bool large) {
  if (large == whole_large_) return;
  whole_large_ = large;
  update();
  Q_EMIT wholeFrameLargeChanged(large);
}

QString RoiView::caption() const {
  if (frame_.empty()) return message_;
  if (!outdated_.isEmpty()) return outdated_;
  if (!detection_.found()) return text(base::nameOf(detection_.fault));
  return QString("circle %1 px · %2 px σ · ok%3")
      .arg(detection_.radius, 0, 'f', 1)
      .arg(detection_.sigma, 0, 'f', 2)
      .arg(detection_.full_frame ? " · found by full search" : "");
}

QString RoiView::captionWithin(const QFontMetrics& metrics, int width) const {
  QStringList parts = caption().split(QString::fromUtf8(" · "));
  while (parts.size() > 1 && metrics.horizontalAdvance(parts.join(QString::fromUtf8(" · "))) > width)
    parts.removeLast();
  return metrics.elidedText(parts.join(QString::fromUtf8(" · ")), Qt::ElideRight, width);
}

RoiLayout RoiView::layOut() const {
  const int height = QFontMetrics(textFont(kTextPoints)).height() + 4;
  const cv::Size whole = frame_.empty() ? cv::Size(640, 480) : frame_.size();
  const cv::Size part = frame_.empty() ? cv::Size(kRegionSide, kRegionSide) : region_.size();
  RoiLayout layout =
      whole_large_ ? layOutRoi(size(), height, whole, part) : layOutRoi(size(), height, part, whole);
  if (!layout.inset_inside || frame_.empty()) return layout;
  const ImageMap map{layout.main, whole_large_ ? wholeFrame() : region_};
  std::vector<QRectF> kept;
  if (!lost()) kept.push_back(markerBox(map));
  for (const ImageLine& line : lines_)
    if (!line.points.empty()) kept.push_back(labelBox(line, map));
  layout.inset = freeCorner(layout.main, layout.inset.size(), kept);
  return layout;
}

/// Box of a line's label and the circle beside it.
QRectF RoiView::labelBox(const ImageLine& line, const ImageMap& map) const {
  const QFontMetricsF metrics(textFont(kTextPoints - 1.0, true));
  const QPointF end = map.toWidget(line.points.back());
  const double radius = line.circle * map.scale();
  const QRectF words(end + QPointF(radius + kLabelGap, (line.dashed ? kBelow : kAbove) - metrics.ascent()),
                     QSizeF(metrics.horizontalAdvance(line.label), metrics.height()));
  return words | QRectF(end - QPointF(radius, radius), QSizeF(2.0 * radius, 2.0 * radius));
}

QRectF RoiView::markerBox(const ImageMap& map) const {
  const double radius = detection_.radius * map.scale();
  return {map.toWidget(detection_.centroid) - QPointF(radius, radius), QSizeF(2.0 * radius, 2.0 * radius)};
}

ImageMap RoiView::mainMap() const { return {layOut().main, whole_large_ ? wholeFrame() : region_}; }
ImageMap RoiView::insetMap() const { return {layOut().inset, whole_large_ ? region_ : wholeFrame()}; }

void RoiView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme_.surface);
  const RoiLayout layout = layOut();
  drawHeader(painter, layout.header);
  if (frame_.empty()) {
    painter.fillRect(layout.main, theme_.raised);
    painter.setPen(theme_.muted);
    painter.setFont(textFont(kTextPoints));
    painter.drawText(layout.main, Qt::AlignCenter | Qt::TextWordWrap, message_);
    return;
  }
  drawImage_(painter, mainMap(), true);
  drawImage_(painter, insetMap(), false);
  drawCaption(painter, layout.caption);
}

void RoiView::drawHeader(QPainter& painter, const QRect& area) const {
  painter.setFont(textFont(kTextPoints, true));
  painter.setPen(theme_.text);
  painter.drawText(area, Qt::AlignLeft | Qt::AlignVCenter, title_);
  if (frame_.empty()) return;
  const int taken = painter.fontMetrics().horizontalAdvance(title_ + "  ");
  painter.setFont(numberFont(kTextPoints - 1.0));
  painter.setPen(theme_.muted);
  const double scale = mainMap().scale();
  const QString shape = whole_large_ ? QString("frame %1×%2").arg(frame_.cols).arg(frame_.rows)
                                     : "ROI " + QString::number(region_.width) + "² px";
  const QString what = shape + " ×" + QString::number(scale, 'f', 1);
  const QRect rest = area.adjusted(taken, 0, 0, 0);
  if (painter.fontMetrics().horizontalAdvance(what) <= rest.width())
    painter.drawText(rest, Qt::AlignRight | Qt::AlignVCenter, what);
}

void RoiView::drawImage_(QPainter& painter, const ImageMap& map, bool main) const {
  if (map.target.isEmpty() || map.source.empty()) return;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
  painter.drawImage(map.target, cut(frame_, map.source, (map.target.size() * devicePixelRatioF()).toSize()));
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setClipRect(map.target);
  if (map.source.width > region_.width) {
    QPainterPath box;
    const QPointF from = map.toWidget({region_.x - 0.5, region_.y - 0.5});
    box.addRect(QRectF(from, QSizeF(region_.width, region_.height) * map.scale()));
    strokeWithHalo(painter, box, lost() ? theme_.warning : theme_.colour(Quantity::kCamera),
                   main ? 1.5 : 1.2);
  }
  drawLines(painter, map);
  drawMarker(painter, map, main);
  painter.restore();
  painter.setBrush(Qt::NoBrush);
  const double edge = main && lost() ? 3.0 : 1.0;
  painter.setPen(QPen(main && lost() ? theme_.warning : theme_.border, edge, Qt::SolidLine, Qt::SquareCap,
                      Qt::MiterJoin));
  painter.drawRect(map.target.adjusted(edge / 2, edge / 2, -edge / 2, -edge / 2));
}

void RoiView::drawMarker(QPainter& painter, const ImageMap& map, bool main) const {
  if (lost()) return;
  const QPointF centre = map.toWidget(detection_.centroid);
  const double radius = detection_.radius * map.scale();
  QPainterPath path;
  path.addEllipse(centre, radius, radius);
  if (main && radius > 8.0) {
    const double gap = 2.5, arm = std::min(0.45 * radius, 12.0);
    for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)}) {
      path.moveTo(centre + way * gap);
      path.lineTo(centre + way * (gap + arm));
    }
  }
  strokeWithHalo(painter, path, theme_.colour(Quantity::kCamera), main ? 2.0 : 1.2);
}

void RoiView::drawLines(QPainter& painter, const ImageMap& map) const {
  for (const ImageLine& line : lines_) {
    if (line.points.empty()) continue;
    QPainterPath path(map.toWidget(line.points.front()));
    for (const auto& point : line.points) path.lineTo(map.toWidget(point));
    const QPointF end = map.toWidget(line.points.back());
    if (line.circle > 0.0) path.addEllipse(end, line.circle * map.scale(), line.circle * map.scale());
    strokeWithHalo(painter, path, line.colour, 1.8, line.dashed ? Qt::DashLine : Qt::SolidLine);
    if (line.label.isEmpty() || map.target.width() < 240) continue;
    painter.setFont(textFont(kTextPoints - 1.0, true));
    const QPointF at = end + QPointF(line.circle * map.scale() + kLabelGap, line.dashed ? kBelow : kAbove);
    QPainterPath words;
    words.addText(at, painter.font(), line.label);
    strokeWithHalo(painter, words, QColor(0, 0, 0, 160), 1.0);
    painter.fillPath(words, line.colour);
  }
}

void RoiView::drawCaption(QPainter& painter, const QRect& area) const {
  int left = area.left();
  const bool words = lost() || !outdated_.isEmpty();
  if (words) {
    const char* pill = outdated_.isEmpty() ? "LOST" : "OLD IMAGE";
    left = drawPill(painter, area, pill, theme_.warning, kTextPoints - 1.0).right() + 8;
  }
  painter.setFont(words ? textFont(kTextPoints) : numberFont(kTextPoints));
  painter.setPen(theme_.text);
  const QRect rest(left, area.top(), area.right() - left, area.height());
  painter.drawText(rest, Qt::AlignLeft | Qt::AlignVCenter,
                   captionWithin(painter.fontMetrics(), rest.width()));
}

void RoiView::mouseDoubleClickEvent(QMouseEvent*) { setWholeFrameLarge(!whole_large_); }

}  // namespace capstan::widgets
