#include "widgets/shell/health_controller.h"

#include <QDockWidget>

#include "widgets/panels/errors/errors_panel.h"
#include "widgets/panels/health/health_panel.h"
#include "widgets/panels/health/health_text.h"
#include "widgets/panels/status/status_line.h"
#include "widgets/shell/session_link.h"

namespace capstan::widgets {

HealthController::HealthController(HealthPanel& panel, QDockWidget& dock, ErrorsPanel& errors,
                                   StatusLine& status, SessionLink& link, QObject* parent)
    : QObject(parent), panel_(panel), dock_(dock), errors_(errors), status_(status), link_(link) {
  connect(&link, &SessionLink::report, this, &HealthController::show);
  connect(&link, &SessionLink::opened, this, [this] {
    panel_.showHealth({}, {});
    errors_.showVerdict({});
    status_.showHealth({});
  });
  connect(&errors, &ErrorsPanel::healthRequested, this, [this] {
    dock_.show();
    dock_.raise();
    dock_.activateWindow();
  });
  connect(&dock, &QDockWidget::visibilityChanged, this, [this](bool visible) {
    if (visible && link_.runner()) show(link_.runner()->report());
  });
}

void HealthController::show(const tracking::TrackReport& report) {
  if (!link_.runner()) return;
  const auto checks = link_.runner()->health();
  errors_.showVerdict(checks.empty() ? QString() : verdictText(tracking::worstOf(checks)));
  status_.showHealth(checks);
  if (dock_.isVisible()) panel_.showHealth(checks, report.innovations);
}

}  // namespace capstan::widgets
