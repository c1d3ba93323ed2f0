#pragma once

class QMenuBar;

namespace capstan::widgets {

class MainWindow;

/// Adds every action of the toolbar to a menu, and a View menu whose keys bring each dock to the front or
/// hide it.
void addMenus(MainWindow& window, QMenuBar& menus);

}  // namespace capstan::widgets
