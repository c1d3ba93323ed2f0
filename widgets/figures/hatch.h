#pragma once

#include <QPainter>
#include <QPainterPath>
#include <QRectF>
#include <algorithm>
#include <cmath>

namespace capstan::widgets {

enum class Hatch { kNone, kRising, kFalling };

/// Adds lines at 45° across `box` to `path`, `gap` apart. Lines are anchored to the page, so that those of
/// neighbouring boxes meet. They are drawn as lines because SVG files have no pattern brush.
inline void addHatch(QPainterPath& path, const QRectF& box, double gap, Hatch hatch) {
  if (hatch == Hatch::kNone || box.width() <= 0.0 || box.height() <= 0.0) return;
  const double l = box.left(), r = box.right(), t = box.top(), b = box.bottom();
  const double step = gap * std::sqrt(2.0);
  const bool rising = hatch == Hatch::kRising;  // on a page y points down: x + y is constant along it
  const double first = rising ? l + t : l - b, last = rising ? r + b : r - t;
  for (double c = std::ceil(first / step) * step; c < last; c += step) {
    const double x0 = std::max(l, rising ? c - b : c + t), x1 = std::min(r, rising ? c - t : c + b);
    if (x1 <= x0) continue;
    path.moveTo(x0, rising ? c - x0 : x0 - c);
    path.lineTo(x1, rising ? c - x1 : x1 - c);
  }
}

}  // namespace capstan::widgets
