#pragma once

#include <QObject>

class QDockWidget;

namespace capstan::widgets {

class MarkerPanel;
class SessionBar;
class SessionLink;

/// Connects the marker panel to the running session: its images, and the limits that the pipeline uses.
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
};

}  // namespace capstan::widgets
