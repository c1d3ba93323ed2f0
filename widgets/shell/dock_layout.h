#pragma once

class QDockWidget;
class QMainWindow;

namespace capstan::widgets {

/// Keeps the panels of occlusion and errors so high that they are not scrolled, except in a low window.
void keepWhole(QMainWindow& window);

/// Divides the window among cameras, scene and panels; in a low window docks become tabs of one place. For
/// users without a saved layout.
void layOutDocks(QMainWindow& window);

/// Makes a hidden dock float, since it is too wide for a column. When it is first shown, it covers the plots,
/// not the cameras, the panels or the toolbar; a place that the user gives it stays.
void floatOverCentre(QMainWindow& window, QDockWidget& dock);

}  // namespace capstan::widgets
