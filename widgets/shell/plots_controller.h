#pragma once

#include <QObject>
#include <vector>

#include "widgets/figures/joint_figure.h"
#include "widgets/figures/joint_history.h"

class QAction;
class QMenu;

namespace capstan::widgets {

class NotesPanel;
class SessionBar;
class SessionLink;

/// The joint plots of the window: keeps the errors of the session for their error view, draws its notes as
/// flags, and fills their context menu.
class PlotsController : public QObject {
  Q_OBJECT

 public:
  PlotsController(JointFigure& figure, SessionLink& link, NotesPanel& notes, SessionBar& bar,
                  QObject* parent);

  /// Errors of the session.
  const JointHistory& errors() const { return errors_; }
  /// Puts the figure, as it is on screen, on the clipboard.
  void copyPicture();
  /// Puts the values in the visible range on the clipboard, as tab-separated text with units.
  void copyNumbers();

 private:
  void fillMenu(QMenu* menu);
  QAction* addToggle(QMenu* menu, const QString& text, bool on, void (JointFigure::*set)(bool));
  void addFlag(double t, const QString& kind, const QString& text);

  JointFigure& figure_;
  SessionBar& bar_;
  JointHistory errors_;
  std::vector<NoteFlag> flags_;
};

}  // namespace capstan::widgets
