#pragma once

class QMainWindow;

namespace capstan::widgets {

/// Gives cameras, scene and panels their share of the window's size; in a low window docks share a place as
/// tabs. For a window whose user has no layout of their own.
void layOutDocks(QMainWindow& window);

}  // namespace capstan::widgets
