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

/// Joins the diagnosis panel to the running session: offers what was just recorded, or the recording that is
/// open; the extended robot takes the place of the one in use; brings the panel in the place of the plots and
/// back; a line in the notes for what was saved.
class DiagnosisController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: holds the plots first, and the panel.
  DiagnosisController(DiagnosisPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                      IdentificationPanel& identification, NotesPanel& notes, QObject* parent);

 private:
  void addAction(QStackedWidget& centre, SessionBar& bar);
  void offerRecordings(SessionLink& link);
  void onStatus(const live::RunStatus& status);
  void useRobots(SessionLink& link, IdentificationPanel& identification, NotesPanel& notes);

  DiagnosisPanel& panel_;
  QString recording_;  ///< under way; empty: none
  double now_ = 0.0;   ///< newest session time [s]
};

}  // namespace capstan::widgets
