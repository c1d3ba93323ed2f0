#pragma once

#include <QScrollArea>

class QStackedWidget;

namespace capstan::widgets {

/// Lets a panel be smaller than it wants to be: what has no room is scrolled to. Tab stops at the area itself
/// only while there is something to scroll, so that arrow keys move it.
class DockScroll : public QScrollArea {
  Q_OBJECT

 public:
  explicit DockScroll(QWidget* content, QWidget* parent = nullptr);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  void chooseFocus();
};

/// The page of `pages` that holds `panel`, scrolled or not.
int pageWith(const QStackedWidget& pages, const QWidget& panel);

}  // namespace capstan::widgets
