#pragma once

#include <QApplication>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QTreeWidgetItem>
#include <algorithm>
#include <utility>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Delegate that draws a bar in a cell, with the cell's text over it. The item stores the length of its bar;
/// bars below kLeast are not drawn.
class ShareBar : public QStyledItemDelegate {
 public:
  static constexpr double kLeast = 0.005;
  using QStyledItemDelegate::QStyledItemDelegate;

  /// Sets the bar of a cell. `share`: share of the cell's width; `solid` false: outline only, for a predicted
  /// value.
  static void set(QTreeWidgetItem& item, int column, double share, const QColor& colour, bool solid = true) {
    item.setData(column, kShare, share);
    item.setData(column, kColour, colour);
    item.setData(column, kSolid, solid);
  }
  static double shareOf(const QTreeWidgetItem& item, int column) {
    return item.data(column, kShare).toDouble();
  }

  /// Draws background, bar, then text, so that neither a selection nor the bar covers the text.
  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    QStyleOptionViewItem cell = option;
    initStyleOption(&cell, index);
    const QString text = std::exchange(cell.text, QString());
    const QStyle* style = cell.widget ? cell.widget->style() : QApplication::style();
    style->drawControl(QStyle::CE_ItemViewItem, &cell, painter, cell.widget);
    const QVariant share = index.data(kShare);
    painter->save();
    if (share.isValid() && share.toDouble() >= kLeast) drawBar(painter, option.rect, share.toDouble(), index);
    painter->setFont(cell.font);
    painter->setPen(cell.palette.color(QPalette::Text));
    painter->drawText(option.rect.adjusted(5, 0, -5, 0), static_cast<int>(cell.displayAlignment), text);
    painter->restore();
  }

 private:
  static void drawBar(QPainter* painter, const QRect& rect, double share, const QModelIndex& index) {
    constexpr int kStrong = 110;  // of 255: text stays readable upon it
    QRectF bar = QRectF(rect).adjusted(3.0, 4.0, -3.0, -4.0);
    bar.setWidth(std::max(1.0, bar.width() * std::clamp(share, 0.0, 1.0)));
    QColor colour = index.data(kColour).value<QColor>();
    painter->setPen(QPen(colour, 1.0));
    colour.setAlpha(index.data(kSolid).toBool() ? kStrong : 0);
    painter->setBrush(colour);
    painter->drawRect(bar);
  }

  enum Role { kShare = Qt::UserRole + 10, kColour, kSolid };
};

}  // namespace capstan::widgets
