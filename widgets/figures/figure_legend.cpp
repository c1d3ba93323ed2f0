#include "widgets/figures/figure_legend.h"

#include "widgets/figures/theme.h"

namespace capstan::widgets {

namespace {

constexpr double kSample = 2.2;  ///< width of a sample in font heights
constexpr double kGap = 0.4;     ///< between sample and word, in font heights
constexpr double kApart = 1.2;   ///< between entries, in font heights
constexpr double kLine = 1.25;   ///< line height, in font heights

}  // namespace

FigureLegend::FigureLegend(QCustomPlot* plot) : QCPLayoutElement(plot) { setLayer("legend"); }

void FigureLegend::fit(double points, double width) {
  points_ = points;
  const QFontMetricsF metrics(textFont(points_));
  const double unit = metrics.height();
  places_.clear();
  double x = 0.0, y = 0.0;
  for (const LegendEntry& entry : entries_) {
    const double wide = (kSample + kGap) * unit + metrics.horizontalAdvance(entry.text);
    if (x > 0.0 && x + wide > width) {
      x = 0.0;
      y += kLine * unit;
    }
    places_.emplace_back(x, y, wide, 1.2 * unit);
    x += wide + kApart * unit;
  }
  height_ = entries_.empty() ? 0 : static_cast<int>(std::ceil(y + kLine * unit)) + 2;
}

std::vector<QRectF> FigureLegend::boxes() const {
  std::vector<QRectF> boxes;
  for (const QRectF& place : places_) boxes.push_back(place.translated(rect().topLeft()));
  return boxes;
}

void FigureLegend::draw(QCPPainter* painter) {
  const QFont font = textFont(points_);
  const double unit = QFontMetricsF(font).height();
  const std::vector<QRectF> all = boxes();
  for (std::size_t i = 0; i < entries_.size() && i < all.size(); ++i) {
    const QRectF& box = all[i];
    painter->save();
    entries_[i].draw(painter, QRectF(box.left(), box.top() + 0.2 * unit, kSample * unit, 0.8 * unit));
    painter->restore();
    painter->setFont(font);
    painter->setPen(text_);
    painter->drawText(box.adjusted((kSample + kGap) * unit, 0.0, 2.0, 0.0),
                      Qt::AlignLeft | Qt::AlignVCenter | Qt::TextSingleLine | Qt::TextDontClip,
                      entries_[i].text);
  }
}

}  // namespace capstan::widgets
