#include "widgets/figures/histogram_bars.h"

#include <cmath>
#include <limits>

namespace capstan::widgets {

namespace {

constexpr double kMark = 3.0;  ///< half width of a mean's mark, in line widths

}  // namespace

HistogramBars::HistogramBars(QCPAxisRect* axes)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("main"), axes),
      axes_(axes),
      mean_(std::numeric_limits<double>::quiet_NaN()) {}

void HistogramBars::setBars(std::vector<double> edges, std::vector<double> heights) {
  edges_ = std::move(edges);
  heights_ = std::move(heights);
}

void HistogramBars::setStyle(const SeriesStyle& style, double line) {
  style_ = style;
  line_ = line;
}

void HistogramBars::draw(QCPPainter* painter) {
  const QCPAxis* x = axes_->axis(QCPAxis::atBottom);
  const QCPAxis* y = axes_->axis(QCPAxis::atLeft);
  const double ground = y->coordToPixel(0.0);
  QPolygonF outline, area;
  QPainterPath hatches;
  for (std::size_t i = 0; i < heights_.size(); ++i) {
    const double left = x->coordToPixel(edges_[i]), right = x->coordToPixel(edges_[i + 1]);
    const double top = y->coordToPixel(heights_[i]);
    if (i == 0) outline.append({left, ground});
    outline.append({left, top});
    outline.append({right, top});
    if (i + 1 == heights_.size()) outline.append({right, ground});
    addHatch(hatches, QRectF(left, top, right - left, ground - top), 4.0 * line_, style_.hatch);
    addHatch(hatches, QRectF(left, top, right - left, ground - top), 4.0 * line_, style_.second_hatch);
  }
  painter->setPen(Qt::NoPen);
  painter->setBrush(style_.fill);
  painter->drawPolygon(outline);
  painter->setBrush(Qt::NoBrush);
  if (!hatches.isEmpty()) painter->strokePath(hatches, QPen(style_.ink, 0.5 * line_));
  painter->setPen(QPen(style_.ink, 1.0 * line_, Qt::SolidLine, Qt::FlatCap, Qt::MiterJoin));
  painter->drawPolyline(outline);
  drawMean(painter);
}

void HistogramBars::drawMean(QCPPainter* painter) const {
  const QCPAxis* axis = axes_->axis(QCPAxis::atBottom);
  if (!axis->range().contains(mean_)) return;
  const double x = axis->coordToPixel(mean_);
  const double top = axes_->top(), size = kMark * line_;
  painter->setPen(style_.pen(1.2 * line_));
  painter->drawLine(QPointF(x, top + size), QPointF(x, axes_->bottom()));
  painter->setPen(QPen(style_.ink, line_));
  painter->setBrush(style_.filled_mark ? QBrush(style_.ink) : QBrush(Qt::NoBrush));
  const QPointF mark[] = {{x - size, top + 1.0}, {x + size, top + 1.0}, {x, top + 1.0 + 1.7 * size}};
  painter->drawPolygon(mark, 3);
  painter->setBrush(Qt::NoBrush);
}

}  // namespace capstan::widgets
