#pragma once

#include <QObject>

class QWidget;

namespace capstan::widgets {

/// Return and Enter press the button that has the focus, in `window` and its floating docks: Space, which
/// would do so elsewhere, runs and pauses.
class PressWithReturn : public QObject {
  Q_OBJECT

 public:
  explicit PressWithReturn(QWidget* window);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* window_;
};

}  // namespace capstan::widgets
