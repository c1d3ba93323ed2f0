#pragma once

class QAction;
class QMainWindow;

namespace capstan::widgets {

class SessionBar;
class ViewMenu;

/// Fills the menu bar of `window` with everything that `bar` has, so that what a narrow window cannot show of
/// the bar is still reached, and with keys alone: F10, or Alt and the letter of a menu. Call it when the bar
/// has all its actions.
void addSessionMenus(QMainWindow& window, SessionBar& bar, ViewMenu& view);

}  // namespace capstan::widgets
