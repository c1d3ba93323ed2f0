#include "widgets/shell/dock_layout.h"

#include <QDockWidget>
#include <QEvent>
#include <QMainWindow>
#include <QStyle>
#include <QTabBar>
#include <algorithm>

namespace capstan::widgets {

namespace {

constexpr int kRoomForAll = 950;  ///< height below which identification and notes are tabs of one place [px]
constexpr int kBars = 160;        ///< menus, toolbar, status line, tabs and gaps, about [px]
constexpr int kStrip = 180;       ///< room around a floating dock that is not worth leaving [px]
constexpr int kRoomForTwo = 680;  ///< height below which all panels of a side are tabs of one place [px]

/// Moves a dock over the central widget when it is first shown.
class FirstPlace : public QObject {
 public:
  FirstPlace(QMainWindow& window, QDockWidget& dock) : QObject(&dock), window_(window), dock_(dock) {
    dock.installEventFilter(this);
  }

 protected:
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() != QEvent::Show || placed_ || !window_.isVisible()) return false;
    placed_ = true;
    const QWidget& centre = *window_.centralWidget();
    const QRect area(centre.mapToGlobal(QPoint(0, 0)), centre.size());
    QSize size = dock_.sizeHint().boundedTo(area.size()).expandedTo(dock_.minimumSizeHint());
    if (area.height() - size.height() < kStrip) size.setHeight(std::max(size.height(), area.height()));
    if (area.width() - size.width() < kStrip) size.setWidth(std::max(size.width(), area.width()));
    dock_.setGeometry(QRect(area.center() - QPoint(size.width() / 2, size.height() / 2), size));
    return false;
  }

 private:
  QMainWindow& window_;
  QDockWidget& dock_;
  bool placed_ = false;
};

}  // namespace

void floatOverCentre(QMainWindow& window, QDockWidget& dock) {
  dock.setAllowedAreas(Qt::NoDockWidgetArea);
  dock.setFloating(true);
  dock.hide();
  new FirstPlace(window, dock);
}

void keepWhole(QMainWindow& window) {
  for (const char* name : {"occlusion", "errors"}) {
    QWidget& panel = *window.findChild<QDockWidget*>(name)->widget();
    panel.setMinimumHeight(window.height() < kRoomForTwo ? 0 : panel.sizeHint().height());
  }
}

void layOutDocks(QMainWindow& window) {
  keepWhole(window);
  const auto dock = [&window](const char* name) { return window.findChild<QDockWidget*>(name); };
  const int width = window.width(), height = window.height();
  const int left = std::clamp(static_cast<int>(0.27 * width), 240, 620);
  int room = 0;  // for the widest panel and its scroll bar
  for (const char* name : {"occlusion", "identification", "errors", "notes"})
    room = std::max(room, dock(name)->widget()->sizeHint().width());
  room += window.style()->pixelMetric(QStyle::PM_ScrollBarExtent);
  const int right = std::clamp(static_cast<int>(0.19 * width), std::min(room, 400), 400);
  window.resizeDocks({dock("cameras"), dock("occlusion")}, {left, right}, Qt::Horizontal);
  window.resizeDocks({dock("cameras"), dock("scene")}, {64 * height / 100, 36 * height / 100}, Qt::Vertical);
  if (height < kRoomForAll) {
    window.tabifyDockWidget(dock("identification"), dock("notes"));
    dock("identification")->raise();
  }
  if (height < kRoomForTwo) {
    window.tabifyDockWidget(dock("cameras"), dock("scene"));
    for (const char* name : {"identification", "errors", "notes"})
      window.tabifyDockWidget(dock("occlusion"), dock(name));
    dock("cameras")->raise();
    dock("occlusion")->raise();
    for (auto* tabs : window.findChildren<QTabBar*>(QString(), Qt::FindDirectChildrenOnly))
      tabs->setStyleSheet(
          "QTabBar { font-size: 9pt; } QTabBar::tab { padding: 4px 3px; }");  // four names fit
  }
  const int occlusion = dock("occlusion")->sizeHint().height(), errors = dock("errors")->sizeHint().height();
  const int rest =
      std::max(150, height - kBars - occlusion - errors);  // identification and, if it fits, notes
  const int notes = height < kRoomForAll ? rest : rest / 4;
  window.resizeDocks({dock("occlusion"), dock("identification"), dock("errors"), dock("notes")},
                     {occlusion, height < kRoomForAll ? rest : rest - notes, errors, notes}, Qt::Vertical);
}

}  // namespace capstan::widgets
