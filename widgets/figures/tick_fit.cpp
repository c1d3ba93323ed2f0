#include "widgets/figures/tick_fit.h"

#include <algorithm>
#include <cmath>

namespace capstan::widgets {

namespace {

constexpr int kLeast = 2;
constexpr double kApartAcross = 0.8, kApartUp = 0.1;  ///< between numbers, in font heights

bool isHorizontal(const QCPAxis& axis) { return axis.orientation() == Qt::Horizontal; }

bool standApart(const QCPAxis& axis) {
  std::vector<QRectF> boxes = tickLabelBoxes(axis);
  const double unit = QFontMetricsF(axis.tickLabelFont()).height();
  const double wide = isHorizontal(axis) ? 0.5 * kApartAcross * unit : 0.0;
  const double high = isHorizontal(axis) ? 0.0 : 0.5 * kApartUp * unit;
  for (QRectF& box : boxes) box.adjust(-wide, -high, wide, high);
  for (std::size_t i = 1; i < boxes.size(); ++i)
    if (boxes[i].intersects(boxes[i - 1])) return false;
  return true;
}

}  // namespace

std::vector<QRectF> tickLabelBoxes(const QCPAxis& axis) {
  std::vector<QRectF> boxes;
  if (!axis.tickLabels() || !axis.visible()) return boxes;
  QVector<double> ticks;
  QVector<QString> labels;
  axis.ticker()->generate(axis.range(), axis.parentPlot()->locale(), axis.numberFormat().at(0).toLatin1(),
                          axis.numberPrecision(), ticks, nullptr, &labels);
  const QFontMetricsF metrics(axis.tickLabelFont());
  const QRectF area = axis.axisRect()->rect();
  const double away = axis.tickLengthOut() + axis.tickLabelPadding();
  for (int i = 0; i < ticks.size(); ++i) {
    if (!axis.range().contains(ticks[i]) || labels[i].isEmpty()) continue;
    const QSizeF size = metrics.size(0, labels[i]);
    const double at = axis.coordToPixel(ticks[i]);
    boxes.push_back(isHorizontal(axis)
                        ? QRectF(QPointF(at - 0.5 * size.width(), area.bottom() + away), size)
                        : QRectF(QPointF(area.left() - away - size.width(), at - 0.5 * size.height()), size));
  }
  return boxes;
}

void fitTickCount(QCPAxis& axis, int most) {
  for (int count = std::max(most, kLeast); count >= kLeast; --count) {
    axis.ticker()->setTickCount(count);
    if (standApart(axis)) return;
  }
}

int overhang(const QCPAxis& axis) {
  const QRectF area = axis.axisRect()->rect();
  double beyond = 0.0;
  for (const QRectF& box : tickLabelBoxes(axis))
    beyond = std::max(beyond, isHorizontal(axis) ? box.right() - area.right() : area.top() - box.top());
  return static_cast<int>(std::ceil(beyond)) + 1;
}

}  // namespace capstan::widgets
