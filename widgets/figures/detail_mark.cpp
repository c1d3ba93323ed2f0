#include "widgets/figures/detail_mark.h"

#include <algorithm>

#include "widgets/figures/figure_text.h"

namespace capstan::widgets {

namespace {

constexpr double kPoints = 9.0;
constexpr double kGap = 4.0;  ///< gap beside the line and around the words [px]

}  // namespace

DetailMark::DetailMark(QCPAxisRect* axes, const JointHistory& history, bool words)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("legend"), axes),
      axes_(axes),
      history_(&history),
      words_(words) {}

void DetailMark::setTheme(const Theme& theme) {
  ink_ = theme.text;
  ground_ = theme.raised;
}

QString DetailMark::text() const {
  const double left = std::max(axes_->axis(QCPAxis::atBottom)->range().lower, history_->begin());
  const double block = history_->blockAt(left);
  return block > 0.0 ? tr("◂ lowest and highest of %1 s").arg(significantText(block, 2)) : QString();
}

void DetailMark::draw(QCPPainter* painter) {
  box_ = QRectF();
  const QString before = text();
  if (before.isEmpty()) return;
  painter->setFont(textFont(kPoints));
  const double wide = QFontMetricsF(painter->font()).horizontalAdvance(before) + 2.0 * kGap;
  const QRect area = axes_->rect();
  const double at = axes_->axis(QCPAxis::atBottom)->coordToPixel(history_->detailBegin());
  const double x = std::clamp<double>(at, area.left(), area.right());
  if (at <= area.right()) {
    painter->setPen(QPen(ink_, 1.0, Qt::DashDotLine));
    painter->drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  }
  if (!words_) return;
  const double left = std::max<double>(x - kGap - wide, area.left() + kGap);
  box_ = drawWords(painter, before, left);
  if (at <= area.right()) drawWords(painter, tr("every sample ▸"), std::max(x + kGap, box_.right() + kGap));
}

QRectF DetailMark::drawWords(QCPPainter* painter, const QString& words, double left) const {
  const QFontMetricsF metrics(painter->font());
  const QRectF box(left, axes_->bottom() - metrics.height() - 1.5 * kGap,
                   metrics.horizontalAdvance(words) + 2.0 * kGap, metrics.height() + kGap);
  painter->fillRect(box, ground_);
  painter->setPen(ink_);
  painter->drawText(box, Qt::AlignCenter | Qt::TextSingleLine | Qt::TextDontClip, words);
  return box;
}

}  // namespace capstan::widgets
