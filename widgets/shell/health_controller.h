#pragma once

#include <QObject>

#include "core/tracking/track_all.h"

class QDockWidget;

namespace capstan::widgets {

class ErrorsPanel;
class HealthPanel;
class SessionLink;
class StatusLine;

/// Shows the health of the session's estimator: its verdict beside the errors, that of NIS in the status
/// line, and the panel on request.
class HealthController : public QObject {
  Q_OBJECT

 public:
  HealthController(HealthPanel& panel, QDockWidget& dock, ErrorsPanel& errors, StatusLine& status,
                   SessionLink& link, QObject* parent);

 private:
  void show(const tracking::TrackReport& report);

  HealthPanel& panel_;
  QDockWidget& dock_;
  ErrorsPanel& errors_;
  StatusLine& status_;
  SessionLink& link_;
};

}  // namespace capstan::widgets
