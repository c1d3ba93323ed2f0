#pragma once

#include <QObject>

class QAction;
class QDockWidget;

namespace capstan::widgets {

class IdentificationPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Joins the identification panel to the running session: samples in, the accepted robot out, an entry in the
/// bar, a line in the notes.
class IdentificationController : public QObject {
  Q_OBJECT

 public:
  IdentificationController(IdentificationPanel& panel, QDockWidget& dock, SessionLink& link, SessionBar& bar,
                           NotesPanel& notes, QObject* parent);

 private:
  void listen(SessionLink& link);
  void chooseRobots(SessionLink& link, NotesPanel& notes);

  IdentificationPanel& panel_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
