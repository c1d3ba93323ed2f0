#pragma once

#include <QObject>

class QMainWindow;
class QWidget;

namespace capstan::widgets {

/// Keyboard operation without a mouse, in the window and its floating docks: the control that takes the focus
/// is scrolled into view, and Return presses the focused button (Space runs and pauses the session).
class KeyboardReach : public QObject {
  Q_OBJECT

 public:
  explicit KeyboardReach(QMainWindow* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QMainWindow* window_;
};

/// Moves the focus to the first control of `content` that Tab reaches.
void focusFirst(QWidget& content);

}  // namespace capstan::widgets
