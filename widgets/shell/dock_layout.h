#pragma once

class QMainWindow;

namespace capstan::widgets {

/// Divides the window among cameras, scene and panels; in a low window docks become tabs of one place. For
/// users without a saved layout.
void layOutDocks(QMainWindow& window);

}  // namespace capstan::widgets
