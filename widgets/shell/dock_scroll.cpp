#include "widgets/shell/dock_scroll.h"

#include <QEvent>
#include <QScrollBar>
#include <QStackedWidget>

namespace capstan::widgets {

namespace {

constexpr int kBorder = 1;    ///< width of the border in the style sheet below [px]
const QSize kLeast(150, 60);  ///< least size, for one control and its scroll bar [px]

}  // namespace

DockScroll::DockScroll(QWidget* content, QWidget* parent) : QScrollArea(parent) {
  setWidgetResizable(true);
  setFrameShape(QFrame::NoFrame);
  setSizePolicy(content->sizePolicy());
  setFocusPolicy(Qt::NoFocus);
  setStyleSheet(
      QStringLiteral("capstan--widgets--DockScroll { border: 1px solid transparent; }"
                     "capstan--widgets--DockScroll:focus { border: 1px solid palette(highlight); }"));
  setWidget(content);
  setAccessibleName(content->windowTitle());
  viewport()->setAutoFillBackground(false);
  for (auto* bar : {horizontalScrollBar(), verticalScrollBar()})
    connect(bar, &QScrollBar::rangeChanged, this, &DockScroll::chooseFocus);
}

QSize DockScroll::sizeHint() const {
  const int frame = 2 * kBorder;
  return widget()->sizeHint().expandedTo(widget()->minimumSizeHint()) + QSize(frame, frame);
}

QSize DockScroll::minimumSizeHint() const { return widget()->minimumSizeHint().boundedTo(kLeast); }

bool DockScroll::eventFilter(QObject* watched, QEvent* event) {
  if (watched == widget() && event->type() == QEvent::LayoutRequest) updateGeometry();
  return QScrollArea::eventFilter(watched, event);
}

void DockScroll::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  chooseFocus();
}

void DockScroll::chooseFocus() {
  const bool more = horizontalScrollBar()->maximum() > 0 || verticalScrollBar()->maximum() > 0;
  setFocusPolicy(more ? Qt::TabFocus : Qt::NoFocus);
}

int pageWith(const QStackedWidget& pages, const QWidget& panel) {
  for (int i = 0; i < pages.count(); ++i)
    if (pages.widget(i) == &panel || pages.widget(i)->isAncestorOf(&panel)) return i;
  return -1;
}

}  // namespace capstan::widgets
