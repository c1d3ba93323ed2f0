#include "widgets/shell/view_menu.h"

#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QShortcut>

#include "widgets/shell/on_screen.h"

namespace capstan::widgets {

namespace {

/// Not hidden, and not behind another dock's tab.
bool inFront(const QDockWidget& dock) { return dock.isVisible() && !dock.visibleRegion().isEmpty(); }

/// The first control that Tab reaches there, or the panel itself.
QWidget* firstControl(QDockWidget& dock) {
  for (QWidget* next = dock.nextInFocusChain(); next != &dock; next = next->nextInFocusChain())
    if (dock.widget()->isAncestorOf(next) && (next->focusPolicy() & Qt::TabFocus) && next->isEnabled() &&
        next->isVisible())
      return next;
  return dock.widget();
}

}  // namespace

ViewMenu::ViewMenu(QMainWindow* window) : QMenu(tr("&View"), window), docks_end_(addSeparator()) {}

void ViewMenu::addDock(QDockWidget* dock) {
  const QKeySequence key(QStringLiteral("Ctrl+%1").arg(++docks_));
  // The key is written beside the tick but acts otherwise, hence no shortcut of the action itself.
  auto* tick = new QAction(dock->windowTitle() + '\t' + key.toString(QKeySequence::NativeText), this);
  tick->setObjectName(QStringLiteral("show_%1").arg(dock->objectName()));
  tick->setCheckable(true);
  insertAction(docks_end_, tick);
  connect(this, &QMenu::aboutToShow, tick, [tick, dock] { tick->setChecked(inFront(*dock)); });
  connect(tick, &QAction::triggered, dock, [this, dock](bool show) {
    if (show)
      bringBack(dock);
    else
      dock->hide();
  });
  auto* shortcut = new QShortcut(key, parentWidget());
  shortcut->setContext(Qt::ApplicationShortcut);  // a floating dock is a window of its own
  shortcut->setAutoRepeat(false);
  connect(shortcut, &QShortcut::activated, dock, [this, dock] { onKey(dock); });
}

void ViewMenu::onKey(QDockWidget* dock) {
  const QWidget* focus = QApplication::focusWidget();
  if (inFront(*dock) && focus && (focus == dock || dock->isAncestorOf(focus)))
    dock->hide();
  else
    bringBack(dock);
}

void ViewMenu::bringBack(QDockWidget* dock) {
  dock->show();
  dock->raise();
  if (dock->isFloating()) {
    keepOnScreen(*dock);
    dock->activateWindow();
  }
  Q_EMIT shown(dock);
  firstControl(*dock)->setFocus(Qt::TabFocusReason);
}

}  // namespace capstan::widgets
