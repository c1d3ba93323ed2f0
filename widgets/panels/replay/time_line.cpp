#include "widgets/panels/replay/time_line.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace capstan::widgets {
namespace {

constexpr int kMargin = 8;            // beside the band [px]
constexpr int kAxis = 15;             // height of the numbers [px]
constexpr int kLabel = 70;            // least distance of two numbers [px]
constexpr int kNear = 4;              // distance of the mouse from a tick that it means [px]
constexpr double kSame = 1e-3;        // events nearer than this are one [s]
constexpr std::size_t kBlocks = 600;  // of the history examined for occlusions

double stepFor(double span, int width) {
  const double least = span * kLabel / std::max(1, width);
  const double power = std::pow(10.0, std::floor(std::log10(std::max(least, 1e-3))));
  for (double factor : {1.0, 2.0, 5.0, 10.0})
    if (factor * power >= least) return factor * power;
  return 10.0 * power;
}

}  // namespace

TimeLine::TimeLine(const JointHistory& history, QWidget* parent) : QWidget(parent), history_(history) {
  setMouseTracking(true);
  setCursor(Qt::PointingHandCursor);
  setAccessibleName(tr("time line"));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TimeLine::setTheme(const Theme& theme) {
  theme_ = theme;
  update();
}

void TimeLine::setRange(double begin, double end) {
  begin_ = begin;
  end_ = end;
  time_ = begin;
  update();
}

double TimeLine::end() const {
  const double newest = history_.empty() ? begin_ : history_.end();
  return std::max({end_, newest, begin_ + 1e-3});
}

void TimeLine::setTime(double t) {
  time_ = t;
  update();
}

void TimeLine::setLoop(const TimeLoop& loop) {
  loop_ = loop;
  update();
}

void TimeLine::clearEvents() {
  events_.clear();
  update();
}

void TimeLine::addEvent(const TimeLineEvent& event) {
  const auto later = [](const TimeLineEvent& a, const TimeLineEvent& b) { return a.t < b.t; };
  events_.insert(std::upper_bound(events_.begin(), events_.end(), event, later), event);
  update();
}

std::optional<double> TimeLine::eventAfter(double t) const {
  for (const TimeLineEvent& event : events_)
    if (event.t > t + kSame) return event.t;
  return std::nullopt;
}

std::optional<double> TimeLine::eventBefore(double t) const {
  for (auto event = events_.rbegin(); event != events_.rend(); ++event)
    if (event->t < t - kSame) return event->t;
  return std::nullopt;
}

QRect TimeLine::band() const {
  return {kMargin, 6, std::max(1, width() - 2 * kMargin), height() - kAxis - 10};
}

int TimeLine::placeOf(double t) const {
  const QRect area = band();
  return area.left() + static_cast<int>(std::lround(area.width() * (t - begin_) / (end() - begin_)));
}

double TimeLine::timeAt(double x) const {
  const QRect area = band();
  return std::clamp(begin_ + (end() - begin_) * (x - area.left()) / area.width(), begin_, end());
}

QColor TimeLine::colourOf(const QString& kind) const {
  if (kind == "note") return theme_.accent;
  if (kind == "fault" || kind == "motor") return theme_.fault;
  if (kind == "occlusion" || kind == "camera") return theme_.warning;
  return theme_.muted;
}

void TimeLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  const QRect area = band();
  painter.fillRect(area, theme_.surface);
  if (!history_.empty()) {
    const int from = placeOf(std::max(begin_, history_.begin())), to = placeOf(history_.end());
    painter.fillRect(QRect(from, area.top(), to - from + 1, area.height()), theme_.border);
    history_.forEachOcclusion(begin_, end(), kBlocks, [&](double begin, double end) {
      const int left = placeOf(begin);
      QColor shade = theme_.muted;
      shade.setAlpha(90);
      painter.fillRect(QRect(left, area.top(), std::max(1, placeOf(end) - left), area.height()), shade);
    });
  }
  if (loop_.closed()) {
    QColor shade = theme_.accent;
    shade.setAlpha(70);
    const int from = placeOf(*loop_.from);
    painter.fillRect(QRect(from, area.top(), placeOf(*loop_.to) - from, area.height()), shade);
  }
  drawTicks(painter);
  painter.setPen(hasFocus() ? theme_.accent : theme_.border);
  painter.drawRect(area.adjusted(0, 0, -1, -1));
  drawAxis(painter);
  const int x = placeOf(time_);
  painter.fillRect(QRect(x - 1, area.top() - 4, 3, area.height() + 8), theme_.text);
}

void TimeLine::drawTicks(QPainter& painter) {
  const QRect area = band();
  for (const TimeLineEvent& event : events_)
    painter.fillRect(QRect(placeOf(event.t) - 1, area.top() + 2, 2, area.height() - 4), colourOf(event.kind));
  painter.setPen(theme_.accent);
  painter.setFont(numberFont(8.0));
  for (const auto& [t, name] : {std::pair{loop_.from, "A"}, std::pair{loop_.to, "B"}}) {
    if (!t) continue;
    painter.fillRect(QRect(placeOf(*t), area.top(), 1, area.height()), theme_.accent);
    painter.drawText(placeOf(*t) + 3, area.top() + 11, name);
  }
}

void TimeLine::drawAxis(QPainter& painter) {
  const QRect area = band();
  painter.setFont(numberFont(8.0));
  painter.setPen(theme_.muted);
  const double step = stepFor(end() - begin_, area.width());
  for (double t = std::ceil(begin_ / step) * step; t <= end() + 1e-9; t += step) {
    const int x = placeOf(t);
    painter.drawLine(x, area.bottom(), x, area.bottom() + 3);
    const QString text = QString("%1 s").arg(t, 0, 'g', 6);
    const int half = kLabel / 2;
    const int left = std::clamp(x - half, 0, std::max(0, width() - kLabel));
    const auto side = left > x - half ? Qt::AlignLeft : left < x - half ? Qt::AlignRight : Qt::AlignHCenter;
    painter.drawText(QRect(left, area.bottom() + 3, kLabel, kAxis), side | Qt::AlignTop, text);
  }
}

void TimeLine::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  const double t = timeAt(event->localPos().x());
  loop_from_.reset();
  if (event->modifiers() & Qt::ShiftModifier)
    loop_from_ = t;
  else
    Q_EMIT timeChosen(t);
}

void TimeLine::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  const double t = timeAt(event->localPos().x());
  if (loop_from_)
    Q_EMIT loopChosen({std::min(*loop_from_, t), std::max(*loop_from_, t)});
  else
    Q_EMIT timeChosen(t);
}

/// The events under the mouse as tool tip.
bool TimeLine::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto& help = static_cast<const QHelpEvent&>(*event);
  QStringList lines;
  for (const TimeLineEvent& each : events_)
    if (std::abs(placeOf(each.t) - help.pos().x()) <= kNear)
      lines << QString("%1 s  %2  %3").arg(each.t, 0, 'f', 2).arg(each.kind, each.text);
  if (lines.isEmpty())
    lines << tr("%1 s. Click or drag: this time; Shift and drag: a loop")
                 .arg(timeAt(help.pos().x()), 0, 'f', 2);
  QToolTip::showText(help.globalPos(), lines.mid(0, 12).join('\n'), this);
  return true;
}

}  // namespace capstan::widgets
