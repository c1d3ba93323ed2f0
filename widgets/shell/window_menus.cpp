#include "widgets/shell/window_menus.h"

#include <QAction>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>

#include "widgets/shell/keyboard_reach.h"
#include "widgets/shell/layout_controller.h"
#include "widgets/shell/main_window.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/source_menu.h"

namespace capstan::widgets {

namespace {

// Docks by the number of their key; the registration has a key of its own.
constexpr std::array kDocks = {"cameras", "scene", "occlusion", "identification", "errors", "notes"};
constexpr std::array kFloating = {"health", "calibration", "filter"};  // by the keys after those

void addActions(QMenu& menu, const MainWindow& window, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (*name)
      menu.addAction(window.action(name));
    else
      menu.addSeparator();
}

bool inFront(const QDockWidget& dock) { return dock.isVisible() && !dock.visibleRegion().isEmpty(); }

/// Brings a dock behind another tab to the front, with the focus; hides a dock in front.
void toggle(QDockWidget& dock) {
  if (inFront(dock)) {
    dock.close();
    return;
  }
  dock.show();
  dock.raise();
  if (dock.isFloating()) dock.activateWindow();
  focusFirst(*dock.widget());
}

QAction* addDock(QMenu& view, MainWindow& window, const char* name, int number) {
  auto* dock = window.findChild<QDockWidget*>(name);
  auto* action = view.addAction(dock->windowTitle());
  action->setObjectName(QStringLiteral("view_%1").arg(name));
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+%1").arg(number)));
  action->setCheckable(true);
  window.addAction(action);
  QObject::connect(action, &QAction::triggered, dock, [dock] { toggle(*dock); });
  QObject::connect(dock, &QDockWidget::visibilityChanged, action, &QAction::setChecked);
  return action;
}

/// Hides all docks, or shows those that were visible before.
void addAllDocks(QMenu& view, MainWindow& window) {
  auto* action = view.addAction(QObject::tr("All panels, or none"));
  action->setObjectName("view_docks");
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+0")));
  window.addAction(action);
  QObject::connect(action, &QAction::triggered, &window, [&window] {
    int away = 0;
    for (const char* name : kDocks) away += window.findChild<QDockWidget*>(name)->isHidden();
    for (const char* name : kDocks) window.findChild<QDockWidget*>(name)->setVisible(away > 0);
  });
}

}  // namespace

void addMenus(MainWindow& window, QMenuBar& menus) {
  auto* session = menus.addMenu(QObject::tr("Sessio&n"));
  addActions(*session, window, {"run", "step"});
  addActions(*session->addMenu(QObject::tr("Speed")), window, {"slower", "faster"});
  session->addMenu(&window.bar().sources());
  addActions(*session, window,
             {"", "record", "recordingFolder", "showFolder", "", "note", "export", "exportEverything", "",
              "rerunWith", "compareWith", "endComparison"});
  addActions(*menus.addMenu(QObject::tr("&Edit")), window, {"undo", "redo"});
  auto* view = menus.addMenu(QObject::tr("&View"));
  for (std::size_t i = 0; i < kDocks.size(); ++i) addDock(*view, window, kDocks[i], static_cast<int>(i) + 1);
  for (std::size_t i = 0; i < kFloating.size(); ++i)
    addDock(*view, window, kFloating[i], static_cast<int>(kDocks.size() + i) + 1);
  addActions(*view, window, {"marker", "register"});
  view->addSeparator();
  addAllDocks(*view, window);
  view->addMenu(&window.layouts());
  view->addSeparator();
  addActions(*view, window, {"analyse", "diagnose", "learn", "", "theme"});
  auto* tools = menus.addMenu(QObject::tr("T&ools"));
  addActions(*tools, window,
             {"marker", "view_calibration", "register", "identify", "analyse", "diagnose", "learn", "motors",
              "monitor"});
  auto* help = menus.addMenu(QObject::tr("&Help"));
  addActions(*help, window, {"help"});
}

}  // namespace capstan::widgets
