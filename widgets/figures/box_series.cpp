#include "widgets/figures/box_series.h"

#include <algorithm>

#include "widgets/figures/figure_text.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

namespace {

constexpr double kDot = 1.1;         ///< radius of an outlier, in line widths
constexpr double kArrow = 4.0;       ///< height of an arrow, in line widths
constexpr double kCountShare = 0.9;  ///< font size of a count, relative to a median's

}  // namespace

BoxSeries::BoxSeries(QCPAxisRect* axes)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("main"), axes), axes_(axes) {}

void BoxSeries::setStyle(const SeriesStyle& style, const QColor& text, double line, double points) {
  style_ = style;
  text_ = text;
  line_ = line;
  points_ = points;
}

double BoxSeries::widestNumber() const {
  const QFontMetricsF metrics(textFont(points_));
  double widest = 0.0;
  for (const Box& box : boxes_)
    if (box.statistics.n > 0) widest = std::max(widest, metrics.horizontalAdvance(numberOf(box)));
  return widest;
}

double BoxSeries::numberHeight() const { return QFontMetricsF(textFont(points_)).height(); }

QString BoxSeries::numberOf(const Box& box) const { return significantText(box.statistics.median); }

double BoxSeries::stripHeight() const { return upright_ ? 8.0 + widestNumber() : 4.0 + numberHeight(); }

int BoxSeries::above(const Box& box) const {
  const auto& all = box.statistics.outliers;
  return static_cast<int>(std::count_if(all.begin(), all.end(), [&](double v) { return v > seen_.upper; }));
}

int BoxSeries::below(const Box& box) const {
  const auto& all = box.statistics.outliers;
  return static_cast<int>(std::count_if(all.begin(), all.end(), [&](double v) { return v < seen_.lower; }));
}

double BoxSeries::headroom() const {
  const bool any = std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) { return above(box) > 0; });
  return stripHeight() + (any ? kCountShare * numberHeight() + kArrow * line_ : 0.0) + 3.0;
}

double BoxSeries::footroom() const {
  const bool any = std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) { return below(box) > 0; });
  return any ? kCountShare * numberHeight() + kArrow * line_ + 3.0 : 3.0;
}

void BoxSeries::draw(QCPPainter* painter) {
  for (const Box& box : boxes_) {
    if (box.statistics.n == 0) continue;
    drawOutliers(painter, box);
    drawBox(painter, box);
    drawNumber(painter, box);
  }
}

void BoxSeries::drawBox(QCPPainter* painter, const Box& box) const {
  const QCPAxis* x = axes_->axis(QCPAxis::atBottom);
  const QCPAxis* y = axes_->axis(QCPAxis::atLeft);
  const stats::Boxplot& s = box.statistics;
  const double left = x->coordToPixel(box.x - box.half_width),
               right = x->coordToPixel(box.x + box.half_width);
  const double middle = 0.5 * (left + right), cap = 0.25 * (right - left);
  const double top = y->coordToPixel(s.third_quartile), bottom = y->coordToPixel(s.first_quartile);
  const QRectF area(left, top, right - left, bottom - top);
  style_.fillBox(painter, area, line_);
  painter->setBrush(Qt::NoBrush);
  painter->setPen(style_.pen(1.1 * line_));
  painter->drawRect(area);
  painter->setPen(QPen(style_.ink, 1.1 * line_));
  for (const auto& [from, to] :
       {std::pair{s.third_quartile, s.upper_whisker}, std::pair{s.first_quartile, s.lower_whisker}}) {
    const double end = y->coordToPixel(to);
    painter->drawLine(QPointF(middle, y->coordToPixel(from)), QPointF(middle, end));
    painter->drawLine(QPointF(middle - cap, end), QPointF(middle + cap, end));
  }
  painter->setPen(QPen(text_, 1.6 * line_, Qt::SolidLine, Qt::FlatCap));
  const double median = y->coordToPixel(s.median);
  painter->drawLine(QPointF(left, median), QPointF(right, median));
}

void BoxSeries::drawOutliers(QCPPainter* painter, const Box& box) const {
  const QCPAxis* x = axes_->axis(QCPAxis::atBottom);
  const QCPAxis* y = axes_->axis(QCPAxis::atLeft);
  const double middle = x->coordToPixel(box.x), radius = kDot * line_;
  painter->setPen(QPen(style_.ink, 0.5 * line_));
  painter->setBrush(style_.filled_mark ? QBrush(style_.ink) : QBrush(Qt::NoBrush));
  for (const double value : box.outliers)
    if (seen_.contains(value)) painter->drawEllipse(QPointF(middle, y->coordToPixel(value)), radius, radius);
  painter->setBrush(Qt::NoBrush);
  if (const int count = above(box)) drawBeyond(painter, middle, axes_->top() + stripHeight(), -1, count);
  if (const int count = below(box)) drawBeyond(painter, middle, axes_->bottom() - line_, 1, count);
}

/// Draws an arrow with its tip at (x, y), and beside it the number of samples beyond the axis; `direction`
/// −1: up.
void BoxSeries::drawBeyond(QCPPainter* painter, double x, double y, int direction, int count) const {
  const double size = kArrow / 1.6 * line_;
  painter->setPen(Qt::NoPen);
  painter->setBrush(style_.ink);
  const QPointF arrow[] = {
      {x, y}, {x - size, y - 1.6 * direction * size}, {x + size, y - 1.6 * direction * size}};
  painter->drawPolygon(arrow, 3);
  painter->setBrush(Qt::NoBrush);
  painter->setPen(text_);
  painter->setFont(textFont(kCountShare * points_));
  const double height = QFontMetricsF(painter->font()).height();
  painter->drawText(QRectF(x - 50.0, direction < 0 ? y + 1.6 * size : y - 1.6 * size - height, 100.0, height),
                    Qt::AlignCenter | Qt::TextSingleLine | Qt::TextDontClip, QString::number(count));
}

void BoxSeries::drawNumber(QCPPainter* painter, const Box& box) const {
  const double x = axes_->axis(QCPAxis::atBottom)->coordToPixel(box.x);
  const QString text = numberOf(box);
  const QFont font = textFont(points_);
  const QFontMetricsF metrics(font);
  const double wide = metrics.horizontalAdvance(text) + 2.0;
  painter->setFont(font);
  painter->setPen(text_);
  if (!upright_) {
    painter->drawText(QRectF(x - 0.5 * wide, axes_->top() + 1.0, wide, metrics.height()),
                      Qt::AlignCenter | Qt::TextSingleLine | Qt::TextDontClip, text);
    return;
  }
  painter->save();
  painter->translate(x, axes_->top() + 2.0 + wide);
  painter->rotate(-90.0);
  painter->drawText(QRectF(0.0, -0.5 * metrics.height(), wide, metrics.height()),
                    Qt::AlignCenter | Qt::TextSingleLine | Qt::TextDontClip, text);
  painter->restore();
}

}  // namespace capstan::widgets
