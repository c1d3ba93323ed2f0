#pragma once

#include <QObject>

class QStackedWidget;

namespace capstan::widgets {

class LearningPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Brings the learning panel in the place of the plots and back; a line in the notes for what it saved.
class LearningController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: holds the plots first, and the panel.
  LearningController(LearningPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                     NotesPanel& notes, QObject* parent);

 private:
  void addAction(LearningPanel& panel, QStackedWidget& centre, SessionBar& bar);

  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
