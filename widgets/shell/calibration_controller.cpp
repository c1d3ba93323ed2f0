#include "widgets/shell/calibration_controller.h"

#include <QDockWidget>

#include "widgets/panels/calibration/calibration_panel.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

CalibrationController::CalibrationController(CalibrationPanel& panel, QDockWidget& dock, SessionLink& link,
                                             QObject* parent)
    : QObject(parent) {
  connect(&link, &SessionLink::frames, this, [&panel, &dock](const tracking::StereoFrame& frame) {
    if (dock.isVisible()) panel.showFrames(frame);
  });
  connect(&dock, &QDockWidget::visibilityChanged, this, [&panel, &dock] {
    if (dock.isHidden()) panel.stop();
  });
}

}  // namespace capstan::widgets
