#include "widgets/panels/occlusion/occlusion_timeline.h"

#include <QPainter>
#include <cmath>

namespace capstan::widgets {

namespace {
constexpr int kAxisHeight = 16;
constexpr double kTick = 4.0;   // [s]
constexpr double kSpan = 24.0;  // time shown [s], a quarter of it in the past
}  // namespace

OcclusionTimeline::OcclusionTimeline(QWidget* parent) : QWidget(parent) {
  setToolTip("The schedule: shaded while both cameras are blocked; the line is now.");
}

void OcclusionTimeline::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void OcclusionTimeline::setSchedule(const live::OcclusionSchedule& schedule) {
  schedule_ = schedule;
  update();
}

void OcclusionTimeline::setNow(double t) {
  const bool moved = std::lround(xOf(t)) != std::lround(xOf(now_));
  if (!moved) return;
  now_ = t;
  update();
}

double OcclusionTimeline::xOf(double t) const { return width() * ((t - now_) / kSpan + 0.25); }

void OcclusionTimeline::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRect band(0, 2, width(), height() - kAxisHeight - 2);
  painter.fillRect(band, theme_.surface);
  for (int x = 0; x < width(); ++x) {
    const double t = now_ + kSpan * ((x + 0.5) / width() - 0.25);
    if (t >= 0.0 && schedule_.blockedAt(t)) painter.fillRect(x, band.top(), 1, band.height(), theme_.warning);
  }
  painter.setPen(theme_.border);
  painter.drawRect(band.adjusted(0, 0, -1, -1));
  painter.setFont(numberFont(8.0));
  painter.setPen(theme_.muted);
  const double first = std::ceil((now_ - 0.25 * kSpan) / kTick) * kTick;
  for (double t = std::max(0.0, first); t < now_ + 0.75 * kSpan; t += kTick) {
    const int x = static_cast<int>(std::lround(xOf(t)));
    painter.drawLine(x, band.bottom(), x, band.bottom() + 3);
    if (x > 12 && x < width() - 14)
      painter.drawText(QRect(x - 24, band.bottom() + 2, 48, kAxisHeight - 2), Qt::AlignCenter,
                       QString("%1 s").arg(std::lround(t)));
  }
  painter.setPen(QPen(theme_.text, 2.0));
  const int x = static_cast<int>(std::lround(xOf(now_)));
  painter.drawLine(x, band.top() - 1, x, band.bottom() + 1);
}

}  // namespace capstan::widgets
