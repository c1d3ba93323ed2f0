#pragma once

#include <QObject>

#include "core/tracking/track_all.h"

class QDockWidget;

namespace capstan::widgets {

class ErrorsPanel;
class HealthPanel;
class SessionLink;

/// Shows the health of the session's estimator: its verdict beside the errors, and the panel on request.
class HealthController : public QObject {
  Q_OBJECT

 public:
  HealthController(HealthPanel& panel, QDockWidget& dock, ErrorsPanel& errors, SessionLink& link,
                   QObject* parent);

 private:
  void show(const tracking::TrackReport& report);

  HealthPanel& panel_;
  QDockWidget& dock_;
  ErrorsPanel& errors_;
  SessionLink& link_;
};

}  // namespace capstan::widgets
