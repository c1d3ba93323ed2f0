#pragma once

#include <QObject>

namespace capstan::tracking {
struct SourceInfo;
}

namespace capstan::widgets {

class NotesPanel;
class SessionLink;
class StatusLine;

/// Shows the robot in use in the status line, and in the notes if a session starts with a robot that was
/// chosen before. Construct it after the object that clears the notes for a new session.
class RobotController : public QObject {
  Q_OBJECT

 public:
  RobotController(SessionLink& link, StatusLine& status, NotesPanel& notes, QObject* parent);

 private:
  void show(const tracking::SourceInfo& info);
  void report(const tracking::SourceInfo& info);

  SessionLink& link_;
  StatusLine& status_;
  NotesPanel& notes_;
};

}  // namespace capstan::widgets
