#pragma once

#include <QColor>
#include <QFontMetrics>
#include <QPainter>
#include <QRect>
#include <QString>

#include "widgets/figures/theme.h"

namespace capstan::widgets {

/// Draws `word` in dark letters on a rounded patch of `colour`, left and vertically centred in `area`. The
/// word distinguishes the state first, the colour second. Returns the patch.
inline QRect drawPill(QPainter& painter, const QRect& area, const QString& word, const QColor& colour,
                      double points) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(textFont(points, true));
  const QFontMetrics metrics = painter.fontMetrics();
  const QSize size(metrics.horizontalAdvance(word) + 12, std::min(area.height(), metrics.height() + 2));
  const QRect patch(QPoint(area.left(), area.center().y() - size.height() / 2 + 1), size);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawRoundedRect(patch, 4, 4);
  painter.setPen(QColor("#15181c"));
  painter.drawText(patch, Qt::AlignCenter, word);
  painter.restore();
  return patch;
}

}  // namespace capstan::widgets
