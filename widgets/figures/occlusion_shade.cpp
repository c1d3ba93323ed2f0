#include "widgets/figures/occlusion_shade.h"

#include <algorithm>

namespace capstan::widgets {

OcclusionShade::OcclusionShade(QCPAxisRect* axes, const JointHistory& history, bool labelled)
    : QCPLayerable(axes->parentPlot(), QStringLiteral("background"), axes),
      axes_(axes),
      history_(history),
      labelled_(labelled) {}

void OcclusionShade::setTheme(const Theme& theme) {
  shade_ = theme.occluded;
  ink_ = theme.muted;
}

void OcclusionShade::draw(QCPPainter* painter) {
  drawn_ = 0;
  const QCPAxis* time = axes_->axis(QCPAxis::atBottom);
  const QCPRange range = time->range();
  const QRect area = axes_->rect();
  const auto& spans = history_.occluded();
  const std::size_t first = spans.partitionPoint([&](const auto& span) { return span.end < range.lower; });
  painter->setFont(textFont(9.0));
  const QString word = QObject::tr("occluded");
  const int word_width = QFontMetrics(painter->font()).horizontalAdvance(word);
  for (std::size_t i = first; i < spans.size() && spans[i].begin <= range.upper; ++i) {
    const double left = std::max<double>(time->coordToPixel(spans[i].begin), area.left());
    const double right = std::min<double>(time->coordToPixel(spans[i].end), area.right() + 1);
    const QRectF box(left, area.top(), std::max(right - left, 1.0), area.height());
    painter->fillRect(box, shade_);
    ++drawn_;
    if (!labelled_ || box.width() < word_width + 8) continue;
    painter->setPen(ink_);
    painter->drawText(box.adjusted(4, 2, -4, 0), Qt::AlignTop | Qt::AlignLeft, word);
  }
}

}  // namespace capstan::widgets
