#include "widgets/shell/keyboard_reach.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDockWidget>
#include <QKeyEvent>
#include <QMainWindow>
#include <QScrollArea>
#include <QToolButton>

namespace capstan::widgets {

namespace {

/// Every scroll area around the control brings it into view, the innermost first.
void bringIntoView(QWidget& control) {
  constexpr int kMargin = 4;  // [px]
  for (QWidget* up = control.parentWidget(); up && !up->isWindow(); up = up->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(up))
      if (area->widget() && area->widget()->isAncestorOf(&control))
        area->ensureWidgetVisible(&control, kMargin, kMargin);
}

void press(QAbstractButton& button) {
  auto* tool = qobject_cast<QToolButton*>(&button);
  if (tool && tool->menu() && tool->popupMode() == QToolButton::InstantPopup)
    tool->showMenu();
  else
    button.click();
}

}  // namespace

KeyboardReach::KeyboardReach(QMainWindow* window) : QObject(window), window_(window) {
  qApp->installEventFilter(this);
  connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) {
    if (now && window_->isAncestorOf(now)) bringIntoView(*now);
  });
}

bool KeyboardReach::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  if (key->key() != Qt::Key_Return && key->key() != Qt::Key_Enter) return false;
  if (key->modifiers() & ~Qt::KeypadModifier) return false;
  auto* button = qobject_cast<QAbstractButton*>(watched);
  if (!button || !button->hasFocus() || !button->isEnabled()) return false;
  const QWidget* window = button->window();
  if (window != window_ && !(qobject_cast<const QDockWidget*>(window) && window_->isAncestorOf(window)))
    return false;
  if (!key->isAutoRepeat()) press(*button);
  return true;
}

void focusFirst(QWidget& content) {
  QWidget* widget = &content;
  do {
    const bool can = content.isAncestorOf(widget) && widget->isVisible() && widget->isEnabled() &&
                     (widget->focusPolicy() & Qt::TabFocus);
    if (can) return widget->setFocus(Qt::TabFocusReason);
    widget = widget->nextInFocusChain();
  } while (widget != &content);
}

}  // namespace capstan::widgets
