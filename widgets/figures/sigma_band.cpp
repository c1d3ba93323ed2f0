#include "widgets/figures/sigma_band.h"

#include <cmath>

namespace capstan::widgets {

namespace {

constexpr int kPiece = 24;  ///< points per piece filled on screen

bool isGap(const SigmaBand::Point& point) { return std::isnan(point.low) || std::isnan(point.high); }

}  // namespace

SigmaBand::SigmaBand(QCPAxisRect* axes)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("main"), axes), axes_(axes) {}

void SigmaBand::draw(QCPPainter* painter) {
  painter->setPen(Qt::NoPen);
  painter->setBrush(colour_);
  const bool whole = painter->modes().testFlag(QCPPainter::pmVectorized);
  for (int first = 0; first < points_.size();) {
    if (isGap(points_[first])) {
      ++first;
      continue;
    }
    int last = first;
    while (last + 1 < points_.size() && !isGap(points_[last + 1]) && (whole || last - first < kPiece)) ++last;
    if (last > first) fillPiece(painter, first, last);
    first = last > first && last + 1 < points_.size() && !isGap(points_[last + 1]) ? last : last + 1;
  }
}

void SigmaBand::fillPiece(QCPPainter* painter, int first, int last) const {
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QCPAxis* value = axes_->axis(QCPAxis::atLeft);
  QPolygonF outline;
  outline.reserve(2 * (last - first + 1));
  for (int i = first; i <= last; ++i)
    outline.append({time->coordToPixel(points_[i].t), value->coordToPixel(points_[i].high)});
  for (int i = last; i >= first; --i)
    outline.append({time->coordToPixel(points_[i].t), value->coordToPixel(points_[i].low)});
  painter->drawPolygon(outline);
}

}  // namespace capstan::widgets
