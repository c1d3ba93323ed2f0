#pragma once

#include <qcustomplot.h>

#include <vector>

namespace capstan::widgets {

/// Where the numbers of an axis stand at its present range and size, in pixels of the plot; of axes below and
/// left of their rect. Empty: it shows none.
std::vector<QRectF> tickLabelBoxes(const QCPAxis& axis);

/// Takes the most ticks, `most` or fewer but two at least, whose numbers stand apart.
void fitTickCount(QCPAxis& axis, int most);

/// How far the last number reaches beyond the axis' far end [px].
int overhang(const QCPAxis& axis);

}  // namespace capstan::widgets
