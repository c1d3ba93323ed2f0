#include "widgets/figures/axis_style.h"

#include <qcustomplot.h>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

void styleAxis(QCPAxis& axis, const Theme& theme) {
  axis.setBasePen(theme.border);
  axis.setTickPen(theme.border);
  axis.setTickLabelColor(theme.muted);
  axis.setLabelColor(theme.muted);
  axis.setTickLabelFont(numberFont(8.5));
  axis.setLabelFont(textFont(9.0));
  axis.grid()->setPen(QPen(theme.grid, 1.0));
  axis.grid()->setZeroLinePen(QPen(theme.grid, 1.0));
}

}  // namespace capstan::widgets
