#include "widgets/panels/replay/replay_bar.h"

#include <QBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

namespace capstan::widgets {
namespace {

constexpr int kTick = 33;  // [ms]

}  // namespace

ReplayBar::ReplayBar(const JointHistory& history, QWidget* parent) : QWidget(parent), history_(history) {
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("replay"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(6, 2, 6, 2);
  row->setSpacing(4);
  play_ = addButton(QStringLiteral("▶"), tr("Play what was tracked, from the time in view (P)"),
                    &ReplayBar::togglePlaying);
  clock_ = new QLabel;
  clock_->setFont(numberFont(10.0));
  row->addWidget(clock_);
  row->addWidget(line_ = new TimeLine(history), 1);
  from_ = addButton(QStringLiteral("A"), tr("Begin of the loop (A)"), &ReplayBar::setFrom);
  to_ = addButton(QStringLiteral("B"), tr("End of the loop (Shift+A)"), &ReplayBar::setTo);
  clear_ = addButton(QStringLiteral("✕"), tr("No loop"), &ReplayBar::clearLoop);
  follow_ = addButton(tr("Newest"), tr("Follow the newest sample (Esc)"), &ReplayBar::follow);
  connect(line_, &TimeLine::timeChosen, this, &ReplayBar::review);
  connect(line_, &TimeLine::loopChosen, this, &ReplayBar::setLoop);
  timer_.setInterval(kTick);
  connect(&timer_, &QTimer::timeout, this, &ReplayBar::advance);
  refresh();
}

QToolButton* ReplayBar::addButton(const QString& text, const QString& tip, void (ReplayBar::*act)()) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setToolTip(tip);
  button->setAccessibleName(tip);
  button->setFocusPolicy(Qt::NoFocus);
  button->setStyleSheet("QToolButton { padding: 3px 6px; min-width: 14px; }");
  layout()->addWidget(button);
  connect(button, &QToolButton::clicked, this, act);
  return button;
}

void ReplayBar::setTheme(const Theme& theme) { line_->setTheme(theme); }

void ReplayBar::begin(double begin, double duration) {
  timer_.stop();
  time_.reset();
  loop_ = {};
  newest_ = begin;
  line_->setRange(begin, begin + duration);
  line_->clearEvents();
  line_->setLoop(loop_);
  refresh();
}

double ReplayBar::newest() const { return history_.empty() ? newest_ : history_.end(); }

void ReplayBar::setNewest(double t) {
  newest_ = t;
  if (time_)
    line_->update();  // what is tracked grows
  else
    refresh();
}

void ReplayBar::review(double t) {
  if (history_.empty()) return;
  time_ = std::clamp(t, history_.begin(), newest());
  refresh();
  Q_EMIT reviewed(*time_);
}

void ReplayBar::setLoop(const TimeLoop& loop) {
  loop_ = loop;
  line_->setLoop(loop);
  refresh();
}

void ReplayBar::setFrom() { setLoop({time_.value_or(newest()), loop_.to}); }
void ReplayBar::setTo() { setLoop({loop_.from, time_.value_or(newest())}); }
void ReplayBar::clearLoop() { setLoop({}); }

void ReplayBar::togglePlaying() {
  if (timer_.isActive()) {
    timer_.stop();
  } else if (!history_.empty()) {
    const bool at_end = !time_ || *time_ >= newest() - 1e-3;
    if (loop_.closed())
      review(*loop_.from);
    else if (at_end)
      review(history_.begin());
    since_.start();
    timer_.start();
  }
  refresh();
}

void ReplayBar::advance() {
  const double t = time_.value_or(newest()) + speed_ * 1e-3 * static_cast<double>(since_.restart());
  if (loop_.closed() && t >= *loop_.to) return review(*loop_.from);
  if (t >= newest()) timer_.stop();
  review(t);
}

void ReplayBar::follow() {
  timer_.stop();
  time_.reset();
  refresh();
  Q_EMIT followed();
}

void ReplayBar::stepEvent(int by) {
  const double now = time_.value_or(newest());
  const auto to = by > 0 ? line_->eventAfter(now) : line_->eventBefore(now);
  timer_.stop();
  if (to) review(*to);
}

void ReplayBar::stepFrame(int by) {
  timer_.stop();
  review(time_.value_or(newest()) + by * kFrame);
}

void ReplayBar::refresh() {
  const double t = time_.value_or(newest());
  line_->setTime(t);
  clock_->setText(QString("%1 s").arg(t, 8, 'f', 2));
  play_->setText(timer_.isActive() ? QStringLiteral("❚❚") : QStringLiteral("▶"));
  clear_->setEnabled(loop_.from || loop_.to);
  follow_->setEnabled(reviewing());
}

/// The bar's keys are its own while it has the focus, also those that are shortcuts of the window.
bool ReplayBar::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto& key = static_cast<const QKeyEvent&>(*event);
    for (int own :
         {Qt::Key_P, Qt::Key_A, Qt::Key_Left, Qt::Key_Right, Qt::Key_Home, Qt::Key_End, Qt::Key_Escape})
      if (key.key() == own && !(key.modifiers() & (Qt::ControlModifier | Qt::AltModifier))) {
        event->accept();
        return true;
      }
  }
  return QWidget::event(event);
}

void ReplayBar::keyPressEvent(QKeyEvent* event) {
  const bool shift = event->modifiers() & Qt::ShiftModifier;
  switch (event->key()) {
    case Qt::Key_P:
      return togglePlaying();
    case Qt::Key_A:
      return shift ? setTo() : setFrom();
    case Qt::Key_Left:
      return shift ? stepFrame(-1) : stepEvent(-1);
    case Qt::Key_Right:
      return shift ? stepFrame(1) : stepEvent(1);
    case Qt::Key_Home:
      return review(line_->begin());
    case Qt::Key_End:
    case Qt::Key_Escape:
      return follow();
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace capstan::widgets
