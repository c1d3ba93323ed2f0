#include "widgets/panels/diagnosis/interval_cell.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

namespace capstan::widgets {

namespace {

constexpr int kEndsRole = Qt::UserRole + 1;  ///< before, its low and high, after, its low and high; 0…1
constexpr int kColoursRole = Qt::UserRole + 2;
constexpr int kTicksRole = Qt::UserRole + 3;  ///< positions of the ticks, 0…1
constexpr int kNumbersRole = Qt::UserRole + 4;
constexpr int kInkRole = Qt::UserRole + 5;  ///< colour of ticks and numbers
constexpr double kMargin = 10.0;            ///< at both ends of the axis [px]

double xOf(const QRect& cell, double share) {
  return cell.left() + kMargin + share * (cell.width() - 2.0 * kMargin);
}

void setTicks(QTreeWidgetItem& item, int column, const IntervalAxis& axis, const Theme& theme) {
  QVariantList ticks;
  for (const double tick : axis.ticks) ticks << (axis.reach > 0.0 ? tick / axis.reach : 0.0);
  item.setData(column, kTicksRole, ticks);
  item.setData(column, kInkRole, theme.muted);
}

/// Numbers of the ticks at `x`, each within the cell.
void drawNumbers(QPainter* painter, const QRect& cell, const QStringList& numbers,
                 const std::vector<double>& x) {
  std::vector<double> centre, width;
  for (int i = 0; i < numbers.size(); ++i) {
    width.push_back(QFontMetricsF(painter->font()).horizontalAdvance(numbers[i]));
    const double left =
        std::clamp(x[static_cast<std::size_t>(i)] - 0.5 * width.back(), static_cast<double>(cell.left()),
                   std::max<double>(cell.left(), cell.right() - width.back()));
    centre.push_back(left + 0.5 * width.back());
  }
  for (const int i : numbersDrawn(centre, width)) {
    const auto k = static_cast<std::size_t>(i);
    painter->drawText(
        QRectF(centre[k] - 0.5 * width[k], cell.top() + 4.0, width[k] + 1.0, cell.height() - 4.0),
        Qt::AlignCenter, numbers[i]);
  }
}

void drawTicks(QPainter* painter, const QRect& cell, const QModelIndex& index) {
  const QColor ink = index.data(kInkRole).value<QColor>();
  const QStringList numbers = index.data(kNumbersRole).toStringList();
  const QVariantList ticks = index.data(kTicksRole).toList();
  constexpr int kQuiet = 90;  // of 255: the lines stay behind the marks
  QColor line = ink;
  line.setAlpha(kQuiet);
  painter->setPen(QPen(line, 1.0));
  std::vector<double> places;
  for (const QVariant& tick : ticks) {
    const double x = xOf(cell, tick.toDouble());
    places.push_back(x);
    painter->drawLine(QPointF(x, cell.top()),
                      QPointF(x, numbers.isEmpty() ? cell.bottom() + 1 : cell.top() + 4));
  }
  painter->setPen(ink);
  drawNumbers(painter, cell, numbers.mid(0, ticks.size()), places);
}

void drawIntervals(QPainter* painter, const QRect& cell, const QModelIndex& index) {
  const QVariantList ends = index.data(kEndsRole).toList(), colours = index.data(kColoursRole).toList();
  if (ends.size() != 6 || colours.size() != 2) return;
  for (int row = 0; row < 2; ++row) {
    const double y = cell.top() + (row == 0 ? 0.3 : 0.7) * cell.height();
    const QColor colour = colours[row].value<QColor>();
    const int first = 3 * row;
    const auto x = [&](int i) { return xOf(cell, ends[first + i].toDouble()); };
    painter->setPen(QPen(colour, 2.0));
    painter->setBrush(colour);
    painter->drawLine(QPointF(x(1), y), QPointF(x(2), y));
    const QRectF mark(x(0) - 3.5, y - 3.5, 7.0, 7.0);
    row == 0 ? painter->drawRect(mark) : painter->drawEllipse(mark);
  }
}

}  // namespace

std::vector<int> numbersDrawn(const std::vector<double>& centre, const std::vector<double>& width) {
  constexpr double kGap = 6.0;  // between two numbers [px]
  const int count = static_cast<int>(centre.size());
  for (int stride = 1; stride < count; ++stride) {
    std::vector<int> drawn;
    bool fits = true;
    for (int i = 0; i < count; i += stride) {
      const auto at = [](int k) { return static_cast<std::size_t>(k); };
      if (!drawn.empty())
        fits = fits && centre[at(i)] - 0.5 * width[at(i)] >=
                           centre[at(drawn.back())] + 0.5 * width[at(drawn.back())] + kGap;
      drawn.push_back(i);
    }
    if (fits) return drawn;
  }
  return count > 0 ? std::vector<int>{count - 1} : std::vector<int>{};
}

IntervalAxis IntervalAxis::to(double reach) {
  constexpr double kMostSteps = 4.0;
  IntervalAxis axis{reach, {0.0}};
  if (!(reach > 0.0) || !std::isfinite(reach)) return axis;
  const double power = std::pow(10.0, std::floor(std::log10(reach / kMostSteps)));
  double step = 10.0 * power;
  for (const double round : {5.0, 2.0, 1.0})
    if (reach <= kMostSteps * round * power) step = round * power;
  for (int i = 1; i * step <= reach * (1.0 + 1e-9); ++i) axis.ticks.push_back(i * step);
  return axis;
}

void IntervalCell::set(QTreeWidgetItem& item, int column, const diagnosis::Gain& gain, double scale,
                       const IntervalAxis& axis, const Theme& theme) {
  QVariantList ends;
  for (const double value :
       {gain.rms_before, gain.before.low, gain.before.high, gain.rms_after, gain.after.low, gain.after.high})
    ends << (axis.reach > 0.0 && std::isfinite(value) ? scale * value / axis.reach : 0.0);
  item.setData(column, kEndsRole, ends);
  item.setData(column, kColoursRole,
               QVariantList{theme.colour(Quantity::kKinematic), theme.colour(Quantity::kUkf)});
  setTicks(item, column, axis, theme);
}

void IntervalCell::setAxis(QTreeWidgetItem& item, int column, const IntervalAxis& axis, const Theme& theme) {
  QStringList numbers;
  for (const double tick : axis.ticks) numbers << QString::number(tick, 'g', 3);
  setTicks(item, column, axis, theme);
  item.setData(column, kNumbersRole, numbers);
}

QStringList IntervalCell::numbersOf(const QTreeWidgetItem& item, int column) {
  return item.data(column, kNumbersRole).toStringList();
}

void IntervalCell::paint(QPainter* painter, const QStyleOptionViewItem& option,
                         const QModelIndex& index) const {
  QStyledItemDelegate::paint(painter, option, index);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setFont(numberFont(8.5));
  drawTicks(painter, option.rect, index);
  drawIntervals(painter, option.rect, index);
  painter->restore();
}

}  // namespace capstan::widgets
