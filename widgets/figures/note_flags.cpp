#include "widgets/figures/note_flags.h"

#include <cmath>

namespace capstan::widgets {
namespace {

constexpr double kReach = 5.0, kWidth = 8.0, kHeight = 7.0;  // of the pennant [px]

}  // namespace

NoteFlags::NoteFlags(QCPAxisRect* axes, const std::vector<NoteFlag>& flags)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("overlay"), axes), axes_(axes), flags_(flags) {}

const NoteFlag* NoteFlags::at(double x) const {
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const NoteFlag* nearest = nullptr;
  for (const NoteFlag& flag : flags_) {
    const double distance = std::abs(time->coordToPixel(flag.t) - x);
    if (distance <= kReach && (!nearest || distance < std::abs(time->coordToPixel(nearest->t) - x)))
      nearest = &flag;
  }
  return nearest;
}

void NoteFlags::draw(QCPPainter* painter) {
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QRect area = axes_->rect();
  for (const NoteFlag& flag : flags_) {
    if (!time->range().contains(flag.t)) continue;
    const double x = time->coordToPixel(flag.t);
    painter->setPen(QPen(ink_, 1, Qt::DotLine));
    painter->drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
    painter->setPen(Qt::NoPen);
    painter->setBrush(ink_);
    painter->drawPolygon(QPolygonF({QPointF(x, area.top()), QPointF(x + kWidth, area.top() + 0.5 * kHeight),
                                    QPointF(x, area.top() + kHeight)}));
    painter->setBrush(Qt::NoBrush);
  }
}

}  // namespace capstan::widgets
