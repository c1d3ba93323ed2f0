#pragma once

#include <QObject>
#include <array>

#include "core/tracking/snapshot.h"

class QAction;

namespace capstan::widgets {

class JointFigure;
class MessageBar;
class NotesPanel;
class SessionBar;
class SessionLink;

/// Motor encoders that failed, where an operator sees it: beside the title of the joint's plot, in the
/// message bar and the notes; and the bar's menu that says of a motor that it has failed, or is to be
/// used again.
class MotorController : public QObject {
  Q_OBJECT

 public:
  MotorController(JointFigure& figure, SessionLink& link, SessionBar& bar, MessageBar& messages,
                  NotesPanel& notes, QObject* parent);

 private:
  void addMenu(SessionBar& bar, SessionLink& link);
  void keepDeclared(SessionLink& link);
  void showFaults(const tracking::Snapshot& snapshot);
  void report(int motor, tracking::MotorFault fault);

  JointFigure& figure_;
  MessageBar& messages_;
  NotesPanel& notes_;
  std::array<QAction*, 3> failed_{};
  std::array<tracking::MotorFault, 3> faults_{};
  std::array<QString, 3> joints_;
  double now_ = 0.0;  ///< newest session time [s]
};

}  // namespace capstan::widgets
