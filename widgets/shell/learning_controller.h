#pragma once

#include <QObject>

class QStackedWidget;

namespace capstan::widgets {

class LearningPanel;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Switches between the plots and the learning panel, and adds a note for each file that it saved.
class LearningController : public QObject {
  Q_OBJECT

 public:
  /// `centre`: contains the plots first, then the panel.
  LearningController(LearningPanel& panel, QStackedWidget& centre, SessionLink& link, SessionBar& bar,
                     NotesPanel& notes, QObject* parent);

 private:
  void addAction(LearningPanel& panel, QStackedWidget& centre, SessionBar& bar);

  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
