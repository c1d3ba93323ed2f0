#pragma once

#include <QObject>

class QStackedWidget;

namespace capstan::live {
struct RunStatus;
}

namespace capstan::widgets {

class IdentificationPanel;
class DiagnosisPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Connects the diagnosis panel to the running session: offers the recording that was just made or is open,
/// chooses the open one if none is chosen, lets the session use the extended robot, switches between the
/// plots and the panel, and adds a note for each saved file.
class DiagnosisController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: contains the plots first, then the panel.
  DiagnosisController(DiagnosisPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                      IdentificationPanel& identification, NotesPanel& notes, QObject* parent);

 private:
  void addAction(QStackedWidget& centre, SessionBar& bar);
  void offerRecordings(SessionLink& link);
  void onStatus(const live::RunStatus& status);
  void useRobots(SessionLink& link, IdentificationPanel& identification, NotesPanel& notes);

  DiagnosisPanel& panel_;
  QString recording_;  ///< file being recorded; empty: none
  double now_ = 0.0;   ///< newest session time [s]
};

}  // namespace capstan::widgets
