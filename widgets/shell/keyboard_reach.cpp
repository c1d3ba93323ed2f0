#include "widgets/shell/keyboard_reach.h"

#include <QAbstractButton>
#include <QApplication>
#include <QDockWidget>
#include <QKeyEvent>
#include <QMainWindow>
#include <QScrollArea>
#include <QTabBar>
#include <QTimer>
#include <QToolButton>

namespace capstan::widgets {

namespace {

/// Brings a control that is behind another dock's tab to the front, with its dock.
void raiseDockOf(const QWidget& control) {
  for (QWidget* up = control.parentWidget(); up && !up->isWindow(); up = up->parentWidget())
    if (auto* dock = qobject_cast<QDockWidget*>(up))
      if (dock->visibleRegion().isEmpty()) dock->raise();
}

/// For a control larger than the area, its beginning.
void scrollTo(QScrollArea& area, const QWidget& control) {
  constexpr int kMargin = 4;  // [px]
  const QSize room = area.viewport()->size() - QSize(2 * kMargin, 2 * kMargin);
  const QRect place(control.mapTo(area.widget(), QPoint()), control.size().boundedTo(room));
  area.ensureVisible(place.center().x(), place.center().y(), place.width() / 2 + kMargin,
                     place.height() / 2 + kMargin);
}

/// Scrolls every area around the control so that it is visible, the innermost first.
void bringIntoView(const QWidget& control) {
  for (QWidget* up = control.parentWidget(); up && !up->isWindow(); up = up->parentWidget())
    if (auto* area = qobject_cast<QScrollArea*>(up))
      if (area->widget() && area->widget()->isAncestorOf(&control)) scrollTo(*area, control);
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
    if (!now || !window_->isAncestorOf(now)) return;
    raiseDockOf(*now);
    bringIntoView(*now);
    // Repeats it when a raised dock has its size.
    QTimer::singleShot(0, now, [now] {
      if (now->hasFocus()) bringIntoView(*now);
    });
  });
}

bool KeyboardReach::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Show) {
    // Keys bring docks to the front, and Tab goes through all of them, so the tabs themselves are not Tab
    // stops.
    auto* tabs = qobject_cast<QTabBar*>(watched);
    if (tabs && tabs->parentWidget() == window_) tabs->setFocusPolicy(Qt::NoFocus);
  }
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
