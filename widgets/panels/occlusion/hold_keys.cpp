#include "widgets/panels/occlusion/hold_keys.h"

#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QKeyEvent>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTextEdit>

namespace capstan::widgets {

namespace {

/// The main window of a widget, also for widgets in a floating dock.
const QWidget* mainWindowOf(const QWidget& widget) {
  const QWidget* window = widget.window();
  while (qobject_cast<const QDockWidget*>(window) && window->parentWidget())
    window = window->parentWidget()->window();
  return window;
}

}  // namespace

HoldKeys::HoldKeys(QWidget* owner) : QObject(owner), owner_(owner) { qApp->installEventFilter(this); }

bool HoldKeys::typing() const {
  const QWidget* focus = QApplication::focusWidget();
  if (const auto* line = qobject_cast<const QLineEdit*>(focus)) return !line->isReadOnly();
  if (const auto* text = qobject_cast<const QTextEdit*>(focus)) return !text->isReadOnly();
  if (const auto* text = qobject_cast<const QPlainTextEdit*>(focus)) return !text->isReadOnly();
  const auto* box = qobject_cast<const QComboBox*>(focus);
  return box && box->isEditable();
}

bool HoldKeys::eventFilter(QObject* watched, QEvent* event) {
  const bool press = event->type() == QEvent::KeyPress;
  if (!press && event->type() != QEvent::KeyRelease) return false;
  const auto* widget = qobject_cast<QWidget*>(watched);
  if (!widget || mainWindowOf(*widget) != mainWindowOf(*owner_)) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  const auto action = actions_.find(key->key());
  if (action == actions_.end() || key->isAutoRepeat()) return false;
  bool& down = down_[key->key()];
  if (down == press) return false;
  if (press && (typing() || (key->modifiers() & ~Qt::KeypadModifier) || !owner_->isEnabled())) return false;
  down = press;
  action->second(press);
  return true;
}

}  // namespace capstan::widgets
