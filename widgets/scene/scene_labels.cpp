#include "widgets/scene/scene_labels.h"

#include <QFontMetrics>
#include <QLinearGradient>
#include <algorithm>
#include <cmath>
#include <vector>

#include "widgets/figures/number_text.h"

namespace capstan::widgets {

namespace {

constexpr double kSmall = 8.5;

QString signedNewtons(double value) {
  if (!std::isfinite(value)) return QString("%1   ").arg("–", 6);
  return QString("%1 N").arg(signedText(value, 1), 6);
}

}  // namespace

void drawGridLabels(QPainter& painter, const WorkspaceGrid& grid, const OrbitCamera& camera,
                    const QSize& size, const Theme& theme) {
  painter.setPen(theme.muted);
  std::vector<QRectF> taken;
  for (const bool names : {true, false})
    for (const auto& label : grid.labels) {
      const auto at = camera.project(label.at, size);
      if (!at || label.name != names) continue;
      painter.setFont(label.name ? textFont(kSmall, true) : numberFont(kSmall - 0.5));
      const QSizeF extent(painter.fontMetrics().horizontalAdvance(label.text),
                          painter.fontMetrics().height());
      const QRectF box(*at - QPointF(extent.width() / 2, extent.height() / 2), extent);
      const auto hit = [&](const QRectF& other) { return other.intersects(box.adjusted(-3, 0, 3, 0)); };
      if (std::any_of(taken.begin(), taken.end(), hit)) continue;
      painter.drawText(box, Qt::AlignCenter, label.text);
      taken.push_back(box);
    }
}

void drawCameraLabels(QPainter& painter, const SceneCaptions& captions, const OrbitCamera& camera,
                      const QSize& size, const Theme& theme) {
  painter.setFont(textFont(kSmall, true));
  std::array<std::optional<QPointF>, 2> at;
  for (std::size_t side = 0; side < 2; ++side)
    if (captions.cameras[side]) at[side] = camera.project(*captions.cameras[side], size);
  if (!at[0] || !at[1]) return;
  for (std::size_t side = 0; side < 2; ++side) {
    const QString name =
        QString(side == 0 ? "L" : "R") + (captions.marker[side] == MarkerVisibility::kLost ? " lost" : "");
    const QSizeF extent(painter.fontMetrics().horizontalAdvance(name) + 8, painter.fontMetrics().height());
    const bool leftmost = at[side]->x() < at[1 - side]->x();  // labels stand outside the pair
    const QRectF box(*at[side] + QPointF(leftmost ? -extent.width() - 3 : 3, 5), extent);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colourOf(captions.marker[side], theme));
    painter.drawRoundedRect(box, 3, 3);
    painter.setPen(QColor("#15181c"));
    painter.drawText(box, Qt::AlignCenter, name);
  }
}

void drawTensionLegend(QPainter& painter, const SceneCaptions& captions, const TensionScale& scale,
                       const QSize& size, const Theme& theme) {
  const QFontMetrics metrics{numberFont(kSmall)};
  const int row = metrics.height() + 1, width = metrics.horizontalAdvance("q1 +0000.0 N") + 14;
  const int x = size.width() - width - 10, y = 8;
  painter.setFont(textFont(kSmall, true));
  painter.setPen(theme.muted);
  painter.drawText(QRect(x, y, width, row), Qt::AlignLeft | Qt::AlignVCenter, "cable force");
  painter.setFont(numberFont(kSmall));
  for (int i = 0; i < 3; ++i) {
    const QRect line(x, y + (i + 1) * row, width, row);
    painter.setPen(Qt::NoPen);
    painter.setBrush(scale.colour(captions.tension(i)));
    painter.drawRect(QRect(line.left(), line.center().y() - 4, 9, 9));
    painter.setPen(theme.text);
    painter.drawText(line, Qt::AlignRight | Qt::AlignVCenter,
                     QString("q%1 %2").arg(i + 1).arg(signedNewtons(captions.tension(i)), 8));
  }
  const QRect bar(x, y + 4 * row + 4, width, 6);
  QLinearGradient gradient(bar.topLeft(), bar.topRight());
  for (int i = 0; i <= 16; ++i) gradient.setColorAt(i / 16.0, scale.colour(scale.limit() * (i / 8.0 - 1.0)));
  painter.setPen(Qt::NoPen);
  painter.setBrush(gradient);
  painter.drawRect(bar);
  painter.setFont(numberFont(kSmall - 0.5));
  painter.setPen(theme.muted);
  const QRect below(x, bar.bottom() + 2, width, row);
  const QString limit = QString::number(scale.limit(), 'g', 3);
  painter.drawText(below, Qt::AlignLeft | Qt::AlignVCenter, "−" + limit);
  painter.drawText(below, Qt::AlignHCenter | Qt::AlignVCenter, "0");
  painter.drawText(below, Qt::AlignRight | Qt::AlignVCenter, "+" + limit);
}

void drawSceneKey(QPainter& painter, const SceneCaptions& captions, double trail_seconds,
                  const Theme& theme) {
  const QFontMetrics metrics{textFont(kSmall)};
  const int row = metrics.height() + 1;
  painter.setFont(textFont(kSmall));
  const QColor ink = theme.colour(Quantity::kUkf);
  const int x = 10, y = 8;
  painter.setPen(QPen(ink, 2.5));
  painter.drawLine(x, y + row / 2, x + 14, y + row / 2);
  painter.setPen(Qt::NoPen);
  painter.setBrush(ink);
  painter.drawEllipse(QRectF(x + 1, y + row + row / 2 - 4, 12, 8));
  painter.setPen(theme.text);
  painter.drawText(x + 20, y + metrics.ascent(), QString("UKF tip, last %1 s").arg(trail_seconds, 0, 'g', 3));
  const QString scale =
      captions.ellipsoid_scale > 1.0 ? QString(" ×%1").arg(captions.ellipsoid_scale) : QString();
  painter.drawText(x + 20, y + row + metrics.ascent(), "2σ ellipsoid" + scale);
  if (!captions.tip_sigma.allFinite()) return;
  painter.setFont(numberFont(kSmall - 0.5));
  painter.setPen(theme.muted);
  const Eigen::Vector3d mm = 2e3 * captions.tip_sigma;
  painter.drawText(
      x + 20, y + 2 * row + metrics.ascent(),
      QString("± %1 %2 %3 mm").arg(mm.x(), 0, 'f', 2).arg(mm.y(), 0, 'f', 2).arg(mm.z(), 0, 'f', 2));
}

}  // namespace capstan::widgets
