#pragma once

#include <QObject>

class QMainWindow;
class QWidget;

namespace capstan::widgets {

/// For whoever works without a mouse: the control that takes the focus is brought into view, and Return
/// presses the button that has it (Space runs and pauses the session). In the window and its floating docks.
class KeyboardReach : public QObject {
  Q_OBJECT

 public:
  explicit KeyboardReach(QMainWindow* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QMainWindow* window_;
};

/// Gives the focus to the first control of `content` that Tab reaches.
void focusFirst(QWidget& content);

}  // namespace capstan::widgets
