#pragma once

#include <QStringList>
#include <vector>

#include "widgets/figures/panel_figure.h"

/// Whether what a figure draws has room, from its geometry alone: no picture is looked at.
namespace capstan::test {

/// Something that is drawn, and where [px of the page].
struct Drawn {
  QString what;
  QRectF box;
};

/// Least height of the axes of a panel: 10 mm [px of 1/96 inch].
inline constexpr double kLeastHeight = 10.0 / 25.4 * 96.0;

inline QRectF labelBox(const QCPAxis& axis, const std::vector<Drawn>& numbers) {
  const QSizeF size = QFontMetricsF(axis.labelFont()).size(0, axis.label());
  const QRectF area = axis.axisRect()->rect();
  double away = axis.tickLengthOut();
  if (axis.orientation() == Qt::Horizontal) {
    for (const Drawn& one : numbers) away = std::max(away, one.box.bottom() - area.bottom());
    return {area.center().x() - 0.5 * size.width(), area.bottom() + away + axis.labelPadding(), size.width(),
            size.height()};
  }
  for (const Drawn& one : numbers) away = std::max(away, area.left() - one.box.left());
  return {area.left() - away - axis.labelPadding() - size.height(), area.center().y() - 0.5 * size.width(),
          size.height(), size.width()};
}

inline std::vector<Drawn> numbersOf(const QCPAxis& axis) {
  std::vector<Drawn> numbers;
  if (!axis.tickLabels()) return numbers;
  const QFontMetricsF metrics(axis.tickLabelFont());
  const QRectF area = axis.axisRect()->rect();
  const double away = axis.tickLengthOut() + axis.tickLabelPadding();
  for (int i = 0; i < axis.tickVector().size(); ++i) {
    if (!axis.range().contains(axis.tickVector()[i])) continue;
    const QString text = axis.tickVectorLabels()[i];
    const QSizeF size = metrics.size(0, text);
    const double at = axis.coordToPixel(axis.tickVector()[i]);
    const QPointF corner = axis.orientation() == Qt::Horizontal
                               ? QPointF(at - 0.5 * size.width(), area.bottom() + away)
                               : QPointF(area.left() - away - size.width(), at - 0.5 * size.height());
    if (!text.isEmpty()) numbers.push_back({QStringLiteral("number ") + text, QRectF(corner, size)});
  }
  return numbers;
}

/// Numbers and label of an axis; `faults`: numbers without a unit.
inline std::vector<Drawn> drawnAt(const QCPAxis& axis, const QString& where, QStringList& faults) {
  std::vector<Drawn> drawn = numbersOf(axis);
  const QString side = axis.orientation() == Qt::Horizontal ? QStringLiteral("x") : QStringLiteral("y");
  if (!drawn.empty() && (!axis.label().contains('[') || !axis.label().contains(']')))
    faults << QStringLiteral("%1: the %2 axis has no unit: \"%3\"").arg(where, side, axis.label());
  if (!axis.label().isEmpty()) {
    const QRectF box = labelBox(axis, drawn);
    drawn.push_back({side + QStringLiteral(" label ") + axis.label(), box});
  }
  return drawn;
}

inline bool isDrawn(const capstan::widgets::PanelFigure::Panel& panel) {
  return panel.cell->realVisibility() && panel.cell->layout();
}

/// What is wrong, in words; empty: nothing.
inline QStringList layoutFaults(const capstan::widgets::PanelFigure& figure) {
  QStringList faults;
  std::vector<Drawn> drawn;
  if (figure.title().realVisibility())
    for (const QRectF& box : figure.title().boxes()) drawn.push_back({"title", box});
  const std::vector<QRectF> legend = figure.legend().boxes();
  for (std::size_t i = 0; i < legend.size(); ++i)
    drawn.push_back({"legend " + figure.legend().entries()[i].text, legend[i]});
  int panels = 0;
  for (const auto& panel : figure.panels()) {
    if (!isDrawn(panel)) continue;
    const QString where = QStringLiteral("panel %1").arg(++panels);
    if (panel.axes->height() < kLeastHeight)
      faults << QStringLiteral("%1 is %2 px high").arg(where).arg(panel.axes->height());
    for (const QRectF& box : panel.header->boxes()) drawn.push_back({where + " header", box});
    drawn.push_back({where + " axes", QRectF(panel.axes->rect()).adjusted(0, 0, -1, -1)});
    for (const auto type : {QCPAxis::atBottom, QCPAxis::atLeft})
      for (const Drawn& one : drawnAt(*panel.axes->axis(type), where, faults))
        drawn.push_back({where + ' ' + one.what, one.box});
  }
  if (panels == 0) faults << "there is no panel";
  const QRectF page = QRectF(figure.viewport()).adjusted(-0.5, -0.5, 0.5, 0.5);
  constexpr double kRounding = 0.75;  // [px] at each side
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!page.contains(drawn[i].box)) faults << drawn[i].what + " is beyond the page";
    const QRectF box = drawn[i].box.adjusted(kRounding, kRounding, -kRounding, -kRounding);
    for (std::size_t j = 0; j < i; ++j)
      if (box.intersects(drawn[j].box.adjusted(kRounding, kRounding, -kRounding, -kRounding)))
        faults << drawn[j].what + " and " + drawn[i].what + " are upon each other";
  }
  return faults;
}

}  // namespace capstan::test
