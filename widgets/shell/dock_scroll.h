#pragma once

#include <QScrollArea>

class QStackedWidget;

namespace capstan::widgets {

/// Scroll area that lets a panel be smaller than its minimum size. Tab stops at the area itself only while
/// there is something to scroll, so that arrow keys move it.
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

/// Index of the page of `pages` that contains `panel`, in a scroll area or not.
int pageWith(const QStackedWidget& pages, const QWidget& panel);

}  // namespace capstan::widgets
