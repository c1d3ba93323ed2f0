#pragma once

#include <QStyledItemDelegate>
#include <QTreeWidgetItem>
#include <vector>

#include "core/diagnosis/report/report.h"
#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Axis of the drawn intervals of one unit, from 0 to `reach`.
struct IntervalAxis {
  double reach = 0.0;         ///< largest number that is drawn, in the unit for people
  std::vector<double> ticks;  ///< numbers at the axis, the first is 0

  /// Axis with at most five round numbers.
  static IntervalAxis to(double reach);
};

/// Which of the numbers at an axis are drawn, so that none touches another: every number, else every second,
/// and so on; the first and the last if no other fits, and at least the last. `centre`, `width`: of each
/// number [px], from left to right.
std::vector<int> numbersDrawn(const std::vector<double>& centre, const std::vector<double>& width);

/// Delegate that draws in a cell two values with their intervals, one above the other: before as a square,
/// after as a disc. Cells with the same unit share one axis. Each cell draws its ticks as lines; their
/// numbers are in a separate cell.
class IntervalCell : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  /// Sets the values of a cell. `scale`: factor from the gain's unit to that of the axis.
  static void set(QTreeWidgetItem& item, int column, const diagnosis::Gain& gain, double scale,
                  const IntervalAxis& axis, const Theme& theme);
  /// Sets the numbers of the axis.
  static void setAxis(QTreeWidgetItem& item, int column, const IntervalAxis& axis, const Theme& theme);
  /// Numbers of the axis in a cell, empty for other cells.
  static QStringList numbersOf(const QTreeWidgetItem& item, int column);

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace capstan::widgets
