#pragma once

#include <QObject>

class QAction;
class QDockWidget;

namespace capstan::widgets {

class IdentificationPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Connects the identification panel to the running session: passes samples to the panel, the accepted
/// robot and proposed motions to the session, and adds an entry in the bar and notes.
class IdentificationController : public QObject {
  Q_OBJECT

 public:
  IdentificationController(IdentificationPanel& panel, QDockWidget& dock, SessionLink& link, SessionBar& bar,
                           NotesPanel& notes, QObject* parent);

 private:
  void listen(SessionLink& link);
  void drive(SessionLink& link, NotesPanel& notes);
  void chooseRobots(SessionLink& link, NotesPanel& notes);

  IdentificationPanel& panel_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
