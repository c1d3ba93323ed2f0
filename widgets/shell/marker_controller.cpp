#include "widgets/shell/marker_controller.h"

#include <QAction>
#include <QDockWidget>

#include "widgets/panels/marker/marker_panel.h"
#include "widgets/shell/keyboard_reach.h"
#include "widgets/shell/session_bar.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

MarkerController::MarkerController(MarkerPanel& panel, QDockWidget& dock, SessionLink& link, SessionBar& bar,
                                   QObject* parent)
    : QObject(parent), panel_(panel), dock_(dock), link_(link) {
  QAction* action = dock.toggleViewAction();
  action->setObjectName("marker");
  action->setText(tr("Marker"));
  action->setShortcut(QKeySequence(QStringLiteral("Ctrl+K")));
  action->setToolTip(tr("Choose the marker's colour by a click on it (Ctrl+K)"));
  bar.addPanelAction(action);
  connect(action, &QAction::triggered, this, [this](bool shown) {
    if (!shown) return;
    begin();
    dock_.activateWindow();
    focusFirst(panel_);
  });
  connect(&link, &SessionLink::opened, this, [this] {
    panel_.clear();
    if (!link_.again()) chosen_.reset();
    if (chosen_) link_.runner()->setMarker(*chosen_);
    begin();
  });
  connect(&link, &SessionLink::frames, this, [this](const tracking::StereoFrame& frame) {
    if (dock_.isVisible()) panel_.showFrames(frame);
  });
  connect(&panel, &MarkerPanel::optionsChanged, this, [this](const vision::MarkerOptions& options) {
    if (!link_.runner()) return;
    chosen_ = options;
    link_.runner()->setMarker(options);
  });
}

void MarkerController::begin() {
  if (link_.runner()) panel_.begin(link_.runner()->marker());
}

}  // namespace capstan::widgets
