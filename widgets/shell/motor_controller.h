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

/// Shows failed motor encoders beside the title of the joint's plot, in the message bar and in the notes. The
/// menu of the bar declares a motor encoder as failed, or as usable again.
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
