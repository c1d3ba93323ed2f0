#pragma once

#include <QMenu>

class QDockWidget;
class QMainWindow;

namespace capstan::widgets {

/// The docks of a window: a tick shows or hides one. Its key (Ctrl+1 for the first added, and so on) brings
/// it to the front and gives it the focus; where it has the focus, the key hides it.
class ViewMenu : public QMenu {
  Q_OBJECT

 public:
  explicit ViewMenu(QMainWindow* window);
  void addDock(QDockWidget* dock);

 signals:
  /// A dock is to be shown: what it shows may have to begin first.
  void shown(QDockWidget* dock);

 private:
  void bringBack(QDockWidget* dock);
  void onKey(QDockWidget* dock);

  QAction* docks_end_;
  int docks_ = 0;
};

}  // namespace capstan::widgets
