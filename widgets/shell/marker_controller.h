#pragma once

#include <QObject>
#include <optional>

#include "core/vision/marker.h"

class QDockWidget;

namespace capstan::widgets {

class MarkerPanel;
class SessionBar;
class SessionLink;

/// Connects the marker panel to the running session: its images, and the limits that the pipeline uses.
/// Limits that were chosen stay in use when the session begins again.
class MarkerController : public QObject {
  Q_OBJECT

 public:
  MarkerController(MarkerPanel& panel, QDockWidget& dock, SessionLink& link, SessionBar& bar,
                   QObject* parent);

 private:
  void begin();

  MarkerPanel& panel_;
  QDockWidget& dock_;
  SessionLink& link_;
  std::optional<vision::MarkerOptions> chosen_;  ///< by the user, in this session
};

}  // namespace capstan::widgets
