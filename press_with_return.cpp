#include "widgets/shell/press_with_return.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDialog>
#include <QKeyEvent>

namespace capstan::widgets {

PressWithReturn::PressWithReturn(QWidget* window) : QObject(window), window_(window) {
  qApp->installEventFilter(this);
}

bool PressWithReturn::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return false;
  auto* button = qobject_cast<QAbstractButton*>(watched);
  if (!button || !button->isEnabled()) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  if (key->key() != Qt::Key_Return && key->key() != Qt::Key_Enter) return false;
  if (key->isAutoRepeat() || (key->modifiers() & ~Qt::KeypadModifier)) return false;
  const QWidget* window = button->window();  // a dialog has a way of its own
  if (window != window_ && (window->parentWidget() != window_ || qobject_cast<const QDialog*>(window)))
    return false;
  button->click();
  return true;
}

}  // namespace capstan::widgets
