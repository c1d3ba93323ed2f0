#pragma once

#include "widgets/figures/figure_legend.h"

/// The usual samples of a legend.
namespace capstan::widgets {

/// Legend entry of a line, drawn over a band if `band` is a valid colour.
inline LegendEntry lineEntry(const QString& text, const QPen& pen, const QColor& band = {}) {
  return {text, [pen, band](QCPPainter* painter, const QRectF& box) {
            if (band.isValid()) painter->fillRect(box, band);
            painter->setPen(pen);
            painter->drawLine(QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y()));
          }};
}

inline LegendEntry markEntry(const QString& text, const QCPScatterStyle& mark) {
  return {text, [mark](QCPPainter* painter, const QRectF& box) {
            mark.applyTo(painter, mark.pen());
            mark.drawShape(painter, box.center());
          }};
}

inline LegendEntry areaEntry(const QString& text, const QColor& fill) {
  return {text, [fill](QCPPainter* painter, const QRectF& box) { painter->fillRect(box, fill); }};
}

}  // namespace capstan::widgets
