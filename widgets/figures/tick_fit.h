#pragma once

#include <qcustomplot.h>

#include <vector>

namespace capstan::widgets {

/// Boxes of the numbers of an axis at its present range and size, in pixels of the plot; for axes below or
/// left of their rect. Empty: the axis shows no numbers.
std::vector<QRectF> tickLabelBoxes(const QCPAxis& axis);

/// Sets the largest number of ticks, at least two and at most `most`, whose numbers do not overlap.
void fitTickCount(QCPAxis& axis, int most);

/// Length by which the last number extends beyond the axis' far end [px].
int overhang(const QCPAxis& axis);

}  // namespace capstan::widgets
