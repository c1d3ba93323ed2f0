#pragma once

class QMenuBar;

namespace capstan::widgets {

class MainWindow;

/// Every action of the toolbar in a menu, and a View menu whose keys bring each dock to the front or take it
/// away.
void addMenus(MainWindow& window, QMenuBar& menus);

}  // namespace capstan::widgets
