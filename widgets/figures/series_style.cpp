#include "widgets/figures/series_style.h"

namespace capstan::widgets {

namespace {

constexpr double kHatchGap = 4.0;  ///< between hatch lines, in line widths

}  // namespace

QString SeriesKey::name() const {
  const QString name = words.isEmpty() ? nameOf(quantity) : words;
  return run_name.isEmpty() ? name : name + QStringLiteral(" · ") + run_name;
}

SeriesStyle SeriesStyle::of(const SeriesKey& key, const Theme& theme) {
  SeriesStyle style;
  style.ink = theme.colour(key.quantity);
  style.fill = style.ink;
  switch (key.quantity) {
    case Quantity::kTrue:
      style.fill.setAlpha(30);
      break;
    case Quantity::kKinematic:
      style.fill.setAlpha(26);
      style.hatch = Hatch::kRising;
      style.outline = Qt::DashLine;
      style.filled_mark = false;
      break;
    case Quantity::kCamera:
      style.fill.setAlpha(40);
      style.hatch = Hatch::kFalling;
      style.outline = Qt::DotLine;
      style.filled_mark = false;
      break;
    case Quantity::kUkf:
      style.fill.setAlpha(120);
      break;
  }
  if (key.run > 0) {
    style.fill.setAlpha(style.fill.alpha() / 3);
    style.second_hatch = style.hatch == Hatch::kFalling ? Hatch::kRising : Hatch::kFalling;
    if (style.hatch == Hatch::kNone) style.hatch = Hatch::kRising;
    style.outline = Qt::DotLine;
  }
  return style;
}

QPen SeriesStyle::pen(double width) const {
  QPen pen(ink, width, outline, Qt::FlatCap, Qt::MiterJoin);
  if (outline == Qt::DashLine) pen.setDashPattern({4.0, 2.0});
  if (outline == Qt::DotLine) pen.setDashPattern({1.5, 1.5});
  return pen;
}

void SeriesStyle::fillBox(QPainter* painter, const QRectF& box, double unit) const {
  painter->fillRect(box, fill);
  QPainterPath lines;
  addHatch(lines, box, kHatchGap * unit, hatch);
  addHatch(lines, box, kHatchGap * unit, second_hatch);
  if (!lines.isEmpty()) painter->strokePath(lines, QPen(ink, 0.6 * unit));
}

}  // namespace capstan::widgets
