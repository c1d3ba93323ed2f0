#include "widgets/shell/session_menus.h"

#include <QMainWindow>
#include <QMenuBar>
#include <QShortcut>

#include "widgets/shell/session_bar.h"
#include "widgets/shell/source_menu.h"
#include "widgets/shell/view_menu.h"

namespace capstan::widgets {

namespace {

QAction* named(const QMainWindow& window, const char* name) { return window.findChild<QAction*>(name); }

void addSession(QMainWindow& window, SessionBar& bar) {
  auto* menu = window.menuBar()->addMenu(QObject::tr("Sessi&on"));
  for (const char* name : {"run", "step", "slower", "faster"}) menu->addAction(named(window, name));
  menu->addSeparator();
  menu->addActions(bar.sources().actions());
  menu->addSeparator();
  for (const char* name : {"record", "recording_folder", "show_folder"}) menu->addAction(named(window, name));
  menu->addSeparator();
  for (const char* name : {"note", "export"}) menu->addAction(named(window, name));
}

/// What stands between recording and export: one entry a panel.
void addPanels(QMainWindow& window, const SessionBar& bar) {
  auto* menu = window.menuBar()->addMenu(QObject::tr("&Panels"));
  menu->addActions(bar.panelActions());
}

}  // namespace

void addSessionMenus(QMainWindow& window, SessionBar& bar, ViewMenu& view) {
  addSession(window, bar);
  addPanels(window, bar);
  view.addAction(named(window, "theme"));
  window.menuBar()->addMenu(&view);
  window.menuBar()->addMenu(QObject::tr("&Help"))->addAction(named(window, "help"));
  auto* key = new QShortcut(Qt::Key_F10, &window);
  QObject::connect(key, &QShortcut::activated, &window, [&window] {
    window.menuBar()->setFocus(Qt::MenuBarFocusReason);
    window.menuBar()->setActiveAction(window.menuBar()->actions().constFirst());
  });
}

}  // namespace capstan::widgets
